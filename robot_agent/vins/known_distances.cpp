#include "robot_agent/vins/known_distances.hpp"

#include <algorithm>

namespace cosight::vins {

int give_distances(const std::vector<DistanceSighting>& places, double max_apart, FeatureFrame& frame) {
  int given = 0;
  for (const DistanceSighting& place : places) {
    const Eigen::Vector3d ray = place.point.homogeneous().normalized();
    TrackedFeature* nearest = nullptr;
    double nearest_apart = max_apart;
    for (TrackedFeature& feature : frame.features) {
      const double apart = (feature.sighting.bearing() - ray).norm();
      if (feature.distance || apart > nearest_apart) continue;
      nearest = &feature;
      nearest_apart = apart;
    }
    if (nearest == nullptr) continue;
    nearest->distance = place.distance;
    ++given;
  }
  return given;
}

void learn_distances(Window& window, const FeatureFrame& newest) {
  const Pose T_WSj = window.T_WS(window.frames.size() - 1);
  for (const TrackedFeature& feature : newest.features) {
    if (!feature.distance) continue;
    Landmark& landmark = window.landmarks.at(feature.id);
    const Pose T_WSi = window.T_WS(window.slot(landmark.observations.front().frame));
    const Eigen::Vector3d ray = feature.sighting.bearing();
    const KnownDistance from_host = seen_from(*feature.distance, ray, T_WSi.inverse() * T_WSj);
    landmark.known = landmark.known ? fused(*landmark.known, from_host) : from_host;
  }
}

DistanceCheck check_distances(const Window& window) {
  constexpr double kMaxDoubt = 0.1;
  constexpr double kFarthest = 1e-4;  // [1/m]; keeps the ratio of a point at infinity finite
  std::vector<double> ratios;
  for (const auto& [id, landmark] : window.landmarks) {
    if (!landmark.has_depth || !landmark.known) continue;
    if (landmark.known->sigma > kMaxDoubt * landmark.known->lambda) continue;
    ratios.push_back(landmark.known->lambda / std::max(landmark.lambda, kFarthest));
  }
  if (ratios.empty()) return {};
  const auto middle = ratios.begin() + static_cast<std::ptrdiff_t>(ratios.size() / 2);
  std::nth_element(ratios.begin(), middle, ratios.end());
  return {static_cast<int>(ratios.size()), *middle};
}

bool contradicts(const DistanceCheck& check) {
  constexpr int kEnough = 5;
  constexpr double kTolerance = 1.5;
  return check.count >= kEnough && (check.ratio > kTolerance || check.ratio < 1.0 / kTolerance);
}

}  // namespace cosight::vins
