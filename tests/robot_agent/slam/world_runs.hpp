#pragma once

#include <vector>

#include "robot_agent/slam/collaborative_slam.hpp"
#include "tests/robot_agent/slam/two_camera_world.hpp"

namespace cosight::slam {

/// TwoCameraWorld::instance(), in a word.
const TwoCameraWorld& world();

/// Slam as that world's options have it.
CollaborativeSlam collaborative();

/// Frames first <= frame < last, with the wearer or as if there were none.
std::vector<FrameEstimate> run(CollaborativeSlam& slam, int first, int last);
std::vector<FrameEstimate> run_without_wearer(CollaborativeSlam& slam, int first, int last);

/// Distance from the truth of that frame [m]; the estimate's own standard deviation of it [m].
double position_error(const FrameEstimate& estimate, int frame);
double position_std(const FrameEstimate& estimate);

/// Worn matches of mapped landmarks that were fused.
int points_fused(const std::vector<FrameEstimate>& estimates);

/// Finite, of unit length, and with a covariance that is one.
void expect_sound(const FrameEstimate& estimate);

}  // namespace cosight::slam
