#include "robot_agent/vins/triangulation.hpp"

#include <algorithm>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {

std::optional<double> triangulate(const Window& window, const Landmark& landmark) {
  if (landmark.observations.size() < 2) return std::nullopt;
  const Observation& host = landmark.observations.front();
  const Pose T_WSi = window.T_WS(window.slot(host.frame));
  const Eigen::Vector3d f_i = host.sighting.bearing();
  // Times lambda: f_j x ( R_ji f_i + lambda t_ji ) = 0, linear in lambda; no trouble at infinity.
  double numerator = 0.0;
  double denominator = 0.0;
  for (std::size_t k = 1; k < landmark.observations.size(); ++k) {
    const Observation& seen = landmark.observations[k];
    const Pose T_ji = window.T_WS(window.slot(seen.frame)).inverse() * T_WSi;
    const Eigen::Vector3d f_j = seen.sighting.bearing();
    const Eigen::Vector3d a = f_j.cross(T_ji.p);
    const Eigen::Vector3d b = f_j.cross(T_ji.q * f_i);
    numerator -= a.dot(b);
    denominator += a.squaredNorm();
  }
  constexpr double kMinBaselineSquared = 1e-4;  // 1 cm across the rays
  if (denominator < kMinBaselineSquared) return std::nullopt;
  constexpr double kMinDistance = 0.1;  // [m]
  return std::clamp(numerator / denominator, 0.0, 1.0 / kMinDistance);
}

void triangulate_all(Window& window, std::size_t min_observations, double default_distance) {
  for (auto& [id, landmark] : window.landmarks) {
    if (landmark.has_depth || landmark.observations.size() < min_observations) continue;
    const double assumed = landmark.known ? landmark.known->lambda : 1.0 / default_distance;
    landmark.lambda = triangulate(window, landmark).value_or(assumed);
    landmark.beside.setZero();
    landmark.has_depth = true;
  }
}

}  // namespace cosight::vins
