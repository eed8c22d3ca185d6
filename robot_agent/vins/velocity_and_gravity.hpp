#pragma once

#include <optional>
#include <vector>

#include "robot_agent/vins/gyroscope_bias.hpp"

namespace cosight::vins {

/// Metric start of a window, in the axes of its first body frame.
struct MetricStart {
  Eigen::Vector3d v_B = Eigen::Vector3d::Zero();  ///< velocity of the first frame [m/s]
  Eigen::Vector3d g_B = Eigen::Vector3d::Zero();  ///< up, of length `gravity` [m/s^2]
};

/// Velocity and gravity, and with them the scale, from rays and accelerations alone. With the rotations from
/// the gyroscope, the camera centres c_j are linear in [v g], and so is, with the distance d of each feature,
///
///   u_j x ( c_h + d u_h - c_j ) = 0.
///
/// The distances are taken out; |g| = gravity is a constraint (a Lagrange multiplier found by bisection).
/// Nothing when the equations do not determine it.
std::optional<MetricStart> estimate_velocity_and_gravity(const std::vector<UnplacedFrame>& frames,
                                                         const Pose& T_BS, double gravity);

}  // namespace cosight::vins
