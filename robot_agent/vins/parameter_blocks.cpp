#include "robot_agent/vins/parameter_blocks.hpp"

#include <algorithm>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {

using Eigen::Map;
using Eigen::Vector3d;

PoseBlock pose_block(const Pose& T) {
  return {T.p.x(), T.p.y(), T.p.z(), T.q.x(), T.q.y(), T.q.z(), T.q.w()};
}

Pose to_pose(const double* block) {
  return {Eigen::Quaterniond(block[6], block[3], block[4], block[5]), Map<const Vector3d>(block)};
}

MotionBlock motion_block(const NavState& state) {
  MotionBlock block;
  Map<Vector3d>(block.data()) = state.v_W;
  Map<Vector3d>(block.data() + 3) = state.bias.accelerometer;
  Map<Vector3d>(block.data() + 6) = state.bias.gyroscope;
  return block;
}

NavState to_state(const double* pose, const double* motion) {
  return {to_pose(pose),
          Map<const Vector3d>(motion),
          {Map<const Vector3d>(motion + 3), Map<const Vector3d>(motion + 6)}};
}

Pose led_on(const Pose& T_WB, const BodyTwist& twist, double dt) {
  if (dt == 0.0) return T_WB;
  return {T_WB.q * quaternion_exp(dt * twist.w_B), T_WB.p + dt * twist.v_W};
}

Pose moved(const Pose& T, const double* delta) {
  return {(T.q * quaternion_exp(Map<const Vector3d>(delta + 3))).normalized(),
          T.p + Map<const Vector3d>(delta)};
}

Eigen::Matrix<double, 6, 1> difference(const Pose& to, const Pose& from) {
  Eigen::Matrix<double, 6, 1> delta;
  delta << to.p - from.p, quaternion_log(from.q.conjugate() * to.q);
  return delta;
}

bool PoseManifold::Plus(const double* x, const double* delta, double* x_plus_delta) const {
  const PoseBlock block = pose_block(moved(to_pose(x), delta));
  std::copy(block.begin(), block.end(), x_plus_delta);
  return true;
}

bool PoseManifold::PlusJacobian(const double* /*x*/, double* jacobian) const {
  Map<Eigen::Matrix<double, 7, 6, Eigen::RowMajor>> J(jacobian);
  J.setIdentity();
  return true;
}

bool PoseManifold::Minus(const double* y, const double* x, double* y_minus_x) const {
  Map<Eigen::Matrix<double, 6, 1>> delta(y_minus_x);
  delta = difference(to_pose(y), to_pose(x));
  return true;
}

bool PoseManifold::MinusJacobian(const double* /*x*/, double* jacobian) const {
  Map<Eigen::Matrix<double, 6, 7, Eigen::RowMajor>> J(jacobian);
  J.setIdentity();
  return true;
}

}  // namespace cosight::vins
