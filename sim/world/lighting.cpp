#include "sim/world/lighting.hpp"

#include <algorithm>
#include <cmath>
#include <opencv2/imgproc.hpp>
#include <utility>

namespace cosight::sim {
namespace {

constexpr double kStep = 0.2 / 1.5;  // between the points at which the light is computed, of the reach

}  // namespace

Lighting::Lighting(std::vector<Eigen::Vector3d> lamps, const Brightness& brightness)
    : lamps_(std::move(lamps)), brightness_(brightness) {}

Lighting::Lighting(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height, double spacing) {
  const auto count = [&](double length) { return static_cast<int>(std::ceil(length / spacing - 0.5)); };
  const Eigen::Vector2d size = high - low;
  for (int row = 0; row < count(size.y()); ++row) {
    for (int column = 0; column < count(size.x()); ++column) {
      lamps_.emplace_back(low.x() + (column + 0.5) * spacing, low.y() + (row + 0.5) * spacing, height);
    }
  }
}

double Lighting::at(const Eigen::Vector3d& p, const Eigen::Vector3d& outward) const {
  const auto& [ambient, strength, reach] = brightness_;
  double light = ambient;
  for (const Eigen::Vector3d& lamp : lamps_) {
    const Eigen::Vector3d way = lamp - p;
    const double distance = way.norm();
    if (distance > 4.0 * reach) continue;
    // Half of it regardless of the direction: light that other walls pass on.
    const double facing = 0.5 + 0.5 * std::max(0.0, way.dot(outward) / std::max(0.05, distance));
    const double fade = 1.0 - distance / (4.0 * reach);
    light += strength * facing * fade * fade / (1.0 + distance * distance / (reach * reach));
  }
  return std::min(light, 1.45);
}

void Lighting::bake(const Quad& quad, cv::Mat& picture) const {
  const Eigen::Vector3d outward = -quad.inward_normal().normalized();
  const double step = kStep * brightness_.reach;
  const int columns = std::max(2, static_cast<int>(quad.edge_s.norm() / step));
  const int rows = std::max(2, static_cast<int>(quad.edge_t.norm() / step));
  cv::Mat light(rows, columns, CV_32F);
  for (int y = 0; y < rows; ++y) {
    for (int x = 0; x < columns; ++x) {
      const Eigen::Vector3d p =
          quad.origin + quad.edge_s * ((x + 0.5) / columns) + quad.edge_t * ((y + 0.5) / rows);
      light.at<float>(y, x) = static_cast<float>(at(p, outward));
    }
  }
  cv::resize(light, light, picture.size(), 0, 0, cv::INTER_LINEAR);
  cv::multiply(picture, light, picture, 1.0, CV_8U);
}

}  // namespace cosight::sim
