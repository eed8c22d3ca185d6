#pragma once

#include <Eigen/Core>
#include <cstdint>

#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::sim {

/// Something that tells the robot where the worn camera is: a motion capture, or laser and AHRS together.
struct TrackerPlan {
  Eigen::Vector3d position_sigma = Eigen::Vector3d::Constant(0.02);    ///< along the axes of Cs [m]
  Eigen::Vector3d rotation_sigma = Eigen::Vector3d::Constant(0.0052);  ///< about the axes of Cs [rad]
};

/// The true T_SF with an error drawn for this frame, and its covariance.
UncertainPose track(const TrackerPlan& plan, const Pose& T_SF, std::uint64_t seed, std::uint64_t frame);

}  // namespace cosight::sim
