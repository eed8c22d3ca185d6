#pragma once

#include <Eigen/Core>
#include <algorithm>
#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

#include "robot_agent/vision/index.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// A smooth random gray field over the plane, the same for the same seed, without repetition within `kPeriod`
/// lattice cells. Defined between pixels too, so that it can be rendered from any view.
class SyntheticTexture {
 public:
  explicit SyntheticTexture(unsigned seed, double cell = 6.0)
      : cell_(cell), lattice_(index(kPeriod * kPeriod)) {
    std::mt19937 random(seed);
    for (double& value : lattice_)
      value = static_cast<double>(random()) / 4294967295.0;
  }

  /// Gray level in [0, 255] at a point of the plane [units of a lattice cell / cell].
  double at(const Eigen::Vector2d& point) const {
    const double fine = noise(point / cell_);
    const double coarse = noise(point / (4.0 * cell_) + Eigen::Vector2d(17.3, 5.1));
    return 255.0 * (0.65 * fine + 0.35 * coarse);
  }

  /// The image whose pixel u shows the plane's point `to_plane(u)`; one sample a pixel.
  template <class ToPlane>
  GrayImage render(int width, int height, ToPlane to_plane) const {
    GrayImage image{width, height, std::vector<std::uint8_t>(index(width * height))};
    for (int y = 0; y < height; ++y) {
      for (int x = 0; x < width; ++x) {
        image.row(y)[x] = static_cast<std::uint8_t>(std::lround(at(to_plane(Eigen::Vector2d(x, y)))));
      }
    }
    return image;
  }

  GrayImage render(int width, int height) const {
    return render(width, height, [](const Eigen::Vector2d& u) { return u; });
  }

 private:
  static constexpr int kPeriod = 512;

  double value(int x, int y) const {
    return lattice_[index((y & (kPeriod - 1)) * kPeriod + (x & (kPeriod - 1)))];
  }

  double noise(const Eigen::Vector2d& point) const {
    const double x0 = std::floor(point.x());
    const double y0 = std::floor(point.y());
    const auto ease = [](double t) { return t * t * (3.0 - 2.0 * t); };
    const double fx = ease(point.x() - x0);
    const double fy = ease(point.y() - y0);
    const int x = static_cast<int>(x0);
    const int y = static_cast<int>(y0);
    const double above = (1.0 - fx) * value(x, y) + fx * value(x + 1, y);
    const double below = (1.0 - fx) * value(x, y + 1) + fx * value(x + 1, y + 1);
    return (1.0 - fy) * above + fy * below;
  }

  double cell_;
  std::vector<double> lattice_;
};

}  // namespace cosight::vision
