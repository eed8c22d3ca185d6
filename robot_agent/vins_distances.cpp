#include "robot_agent/vins_distances.hpp"

#include <cmath>

namespace cosight::robot {

std::vector<vins::DistanceSighting> distances_of(const std::vector<StereoDepth>& depths,
                                                 const CameraModel& camera_S) {
  // n measurements of variance n s^2 have a mean of variance s^2.
  const double root_count = std::sqrt(static_cast<double>(depths.size()));
  std::vector<vins::DistanceSighting> distances;
  for (const StereoDepth& depth : depths) {
    const auto ray = camera_S.unproject(depth.pixel_S);
    if (!ray || ray->z() <= 0.0) continue;
    const double sigma = std::hypot(depth.sigma, root_count * depth.shared_sigma);
    distances.push_back({ray->hnormalized(), {depth.inverse_distance, sigma}});
  }
  return distances;
}

}  // namespace cosight::robot
