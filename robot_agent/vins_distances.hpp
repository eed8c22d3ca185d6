#pragma once

#include <vector>

#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/vins/known_distances.hpp"
#include "shared/geometry/camera_model.hpp"

namespace cosight::robot {

/// What slam knows from the wearer's view of one frame, as VINS takes it: each distance by itself. Their
/// common error, the pose of Cf's, is made larger in each so that all together say no more than it allows.
std::vector<vins::DistanceSighting> distances_of(const std::vector<StereoDepth>& depths,
                                                 const CameraModel& camera_S);

}  // namespace cosight::robot
