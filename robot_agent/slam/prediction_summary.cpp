#include "robot_agent/slam/prediction_summary.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace cosight::slam {
namespace {

double median(std::vector<double>& values) {
  const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
  std::nth_element(values.begin(), middle, values.end());
  return *middle;
}

}  // namespace

double usual_depth(const std::vector<ekf::PixelPrediction>& predictions) {
  std::vector<double> depths;
  for (const auto& prediction : predictions) {
    if (std::isfinite(prediction.depth) && prediction.depth > 0.0) depths.push_back(prediction.depth);
  }
  constexpr double kIndoors = 4.0;
  return depths.empty() ? kIndoors : median(depths);
}

double expected_near(const std::vector<ekf::PixelPrediction>& predictions) {
  double nearest = std::numeric_limits<double>::infinity();
  for (const auto& prediction : predictions) {
    if (prediction.depth > 0.0) nearest = std::min(nearest, prediction.depth);
  }
  return std::isfinite(nearest) ? 0.5 * nearest : 0.0;
}

double median_sigma(const std::vector<ekf::PixelPrediction>& predictions) {
  std::vector<double> sigmas;
  sigmas.reserve(predictions.size());
  for (const auto& prediction : predictions)
    sigmas.push_back(std::sqrt(0.5 * prediction.S.trace()));
  return median(sigmas);
}

}  // namespace cosight::slam
