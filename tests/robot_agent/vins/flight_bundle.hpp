#pragma once

#include <vector>

#include "robot_agent/vins/window.hpp"
#include "shared/evaluation/trajectory.hpp"

namespace cosight::vins {

/// Camera poses by bundle adjustment of tracked features alone: nothing of the IMU in it. `guess` holds a
/// pose a frame; the first stays and the last keeps its place to about a centimetre, since images do not tell
/// the scale. Align it before use.
Trajectory bundle_adjust(const std::vector<FeatureFrame>& frames, const Trajectory& guess);

/// The frames with those features only whose id modulo two is `parity`.
std::vector<FeatureFrame> half_of(const std::vector<FeatureFrame>& frames, FeatureId parity);

}  // namespace cosight::vins
