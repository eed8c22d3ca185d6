#pragma once

#include <vector>

#include "shared/dataset/stamp.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight {

/// Where a camera C was in its world W at one time.
struct StampedPose {
  Stamp stamp = 0;
  Pose T_WC;
};

/// Poses in the order of their stamps, no stamp twice.
using Trajectory = std::vector<StampedPose>;

/// Length of the broken line through the positions [m].
double path_length(const Trajectory& trajectory);

}  // namespace cosight
