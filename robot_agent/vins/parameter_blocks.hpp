#pragma once

#include <ceres/manifold.h>

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <array>

#include "robot_agent/vins/nav_state.hpp"

namespace cosight::vins {

/// A pose as Ceres sees it: [p (m), q as x y z w]. Its tangent is [dp, dtheta] with p + dp and q Exp(dtheta).
using PoseBlock = std::array<double, 7>;
constexpr int kPoseDim = 6;

/// What moves besides the pose: [v (m/s), accelerometer bias (m/s^2), gyroscope bias (rad/s)].
using MotionBlock = std::array<double, 9>;
constexpr int kMotionDim = 9;

PoseBlock pose_block(const Pose& T);
Pose to_pose(const double* block);
MotionBlock motion_block(const NavState& state);
NavState to_state(const double* pose, const double* motion);

/// How a body moves at some instant.
struct BodyTwist {
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< [m/s]
  Eigen::Vector3d w_B = Eigen::Vector3d::Zero();  ///< [rad/s]
};

/// T_WB `dt` seconds later, the twist being constant: p + v_W dt, q Exp(w_B dt). The very same at dt = 0.
Pose led_on(const Pose& T_WB, const BodyTwist& twist, double dt);

/// T + [dp, dtheta]; `delta` has six entries.
Pose moved(const Pose& T, const double* delta);
/// [dp, dtheta] that moves `from` to `to`.
Eigen::Matrix<double, 6, 1> difference(const Pose& to, const Pose& from);

/// The tangent space of a PoseBlock.
///
/// All factors here give their Jacobians with respect to the tangent in the first six columns and zero in the
/// seventh; PlusJacobian is [I6; 0] to match. Ceres only ever uses the product of the two.
class PoseManifold final : public ceres::Manifold {
 public:
  int AmbientSize() const override { return 7; }
  int TangentSize() const override { return kPoseDim; }
  bool Plus(const double* x, const double* delta, double* x_plus_delta) const override;
  bool PlusJacobian(const double* x, double* jacobian) const override;
  bool Minus(const double* y, const double* x, double* y_minus_x) const override;
  bool MinusJacobian(const double* x, double* jacobian) const override;
};

}  // namespace cosight::vins
