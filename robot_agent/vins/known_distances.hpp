#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// A place in an image and how far away what is seen there is, by somebody else's measurement.
struct DistanceSighting {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [x/z, y/z]
  KnownDistance distance;
};

/// Gives each feature of the frame the distance of a place no farther than `max_apart` [rad] from it; a place
/// serves the nearest feature that has none yet. Returns how many were given.
int give_distances(const std::vector<DistanceSighting>& places, double max_apart, FeatureFrame& frame);

/// Brings the distances that came with the newest frame to the hosts of its landmarks, by the window's states
/// as they are now.
void learn_distances(Window& window, const FeatureFrame& newest);

/// How a window's landmarks stand to what others say of their distances.
struct DistanceCheck {
  int count = 0;       ///< of landmarks whose distance others know to a tenth
  double ratio = 1.0;  ///< median of the distance by the window over the known one
};
DistanceCheck check_distances(const Window& window);

/// Whether the window's scale can't be right: enough distances, and as far off as no good wearer's pose puts
/// them.
bool contradicts(const DistanceCheck& check);

}  // namespace cosight::vins
