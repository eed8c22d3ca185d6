#include "robot_agent/vins_odometry.hpp"

#include "shared/geometry/rotation.hpp"

namespace cosight::robot {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

using State = vins::UncertainNavState;
using StateJacobian = Eigen::Matrix<double, 6, 15>;

/// d [p_WS, theta (axes of W)] / d state.
StateJacobian pose_jacobian(const Matrix3d& R_WB, const Vector3d& p_BS) {
  StateJacobian J = StateJacobian::Zero();
  J.block<3, 3>(0, State::kPosition).setIdentity();
  J.block<3, 3>(0, State::kRotation) = -R_WB * skew(p_BS);
  J.block<3, 3>(3, State::kRotation) = R_WB;
  return J;
}

/// d [v_S, omega_S] / d state, for v_S = R_SB ( R_WB^T v_W + omega_B x p_BS ), omega_S = R_SB omega_B.
StateJacobian twist_jacobian(const Matrix3d& R_WB, const Vector3d& v_W, const Pose& T_BS) {
  const Matrix3d R_SB = T_BS.q.toRotationMatrix().transpose();
  StateJacobian J = StateJacobian::Zero();
  J.block<3, 3>(0, State::kRotation) = R_SB * skew(R_WB.transpose() * v_W);
  J.block<3, 3>(0, State::kVelocity) = R_SB * R_WB.transpose();
  J.block<3, 3>(0, State::kGyroscopeBias) = R_SB * skew(T_BS.p);
  J.block<3, 3>(3, State::kGyroscopeBias) = -R_SB;
  return J;
}

}  // namespace

OdometrySample odometry_of(const vins::Window& window, const vins::UncertainNavState& known,
                           const vins::ImuNoise& noise) {
  const vins::WindowFrame& newest = window.frames.back();
  const Pose& T_BS = window.T_BS;
  const Matrix3d R_WB = newest.state.T_WB.q.toRotationMatrix();
  const Matrix3d R_SB = T_BS.q.toRotationMatrix().transpose();
  const std::vector<vins::ImuSample>& imu = newest.imu->samples();
  const Vector3d omega_B = imu.back().angular_velocity_B - newest.state.bias.gyroscope;

  OdometrySample sample;
  sample.stamp = newest.stamp;
  sample.T_WS.T = newest.state.T_WB * T_BS;
  sample.v_S = R_SB * (R_WB.transpose() * newest.state.v_W + omega_B.cross(T_BS.p));
  sample.omega_S = R_SB * omega_B;

  const auto& P = known.covariance;
  const StateJacobian J_pose = pose_jacobian(R_WB, T_BS.p);
  const StateJacobian J_twist = twist_jacobian(R_WB, newest.state.v_W, T_BS);
  sample.T_WS.covariance = J_pose * P * J_pose.transpose();
  // The gyroscope's own noise in one sample, through omega_B.
  const double interval = newest.imu->duration() / static_cast<double>(imu.size() - 1);
  const double variance = noise.gyroscope * noise.gyroscope / interval;
  const auto J_omega = J_twist.middleCols<3>(State::kGyroscopeBias);
  sample.twist_covariance = J_twist * P * J_twist.transpose() + variance * J_omega * J_omega.transpose();
  return sample;
}

}  // namespace cosight::robot
