#include "robot_agent/vins/imu_motion.hpp"

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kP = UncertainNavState::kPosition;
constexpr int kR = UncertainNavState::kRotation;
constexpr int kV = UncertainNavState::kVelocity;
constexpr int kBa = UncertainNavState::kAccelerometerBias;

constexpr int kAlpha = Preintegration::kAlpha;
constexpr int kTheta = Preintegration::kTheta;
constexpr int kBeta = Preintegration::kBeta;

}  // namespace

UncertainNavState led_by_imu(const UncertainNavState& known, const Preintegration& imu, double gravity) {
  const double dt = imu.duration();
  const MotionIncrement m = imu.corrected(known.state.bias);
  const Matrix3d R_WB = known.state.T_WB.q.toRotationMatrix();
  const auto& J = imu.jacobian();

  Preintegration::Matrix F = Preintegration::Matrix::Identity();
  F.block<3, 3>(kP, kR) = -R_WB * skew(m.alpha);
  F.block<3, 3>(kP, kV) = dt * Matrix3d::Identity();
  F.block<3, 6>(kP, kBa) = R_WB * J.block<3, 6>(kAlpha, kBa);
  F.block<3, 3>(kR, kR) = m.gamma.toRotationMatrix().transpose();
  F.block<3, 6>(kR, kBa) = J.block<3, 6>(kTheta, kBa);
  F.block<3, 3>(kV, kR) = -R_WB * skew(m.beta);
  F.block<3, 6>(kV, kBa) = R_WB * J.block<3, 6>(kBeta, kBa);
  Preintegration::Matrix G = Preintegration::Matrix::Identity();  // increments [alpha theta beta] -> [p R v]
  G.block<3, 3>(kP, kAlpha) = R_WB;
  G.block<3, 3>(kV, kBeta) = R_WB;

  UncertainNavState next;
  next.stamp = imu.samples().back().stamp;
  next.state = imu.propagate(known.state, gravity);
  next.covariance = F * known.covariance * F.transpose() + G * imu.covariance() * G.transpose();
  return next;
}

UncertainTwist mean_twist(const UncertainNavState& known, const Preintegration& imu, const Pose& T_BS,
                          double gravity) {
  const double dt = imu.duration();
  const MotionIncrement m = imu.corrected(known.state.bias);
  const Matrix3d R_BW = known.state.T_WB.q.toRotationMatrix().transpose();
  const Matrix3d R_SB = T_BS.q.toRotationMatrix().transpose();
  const Matrix3d R_turn = m.gamma.toRotationMatrix();  // B at the end in B at the start
  const Vector3d fall_B = R_BW * Vector3d(0.0, 0.0, 0.5 * dt * dt * gravity);
  const Vector3d v_B = R_BW * known.state.v_W;
  const Vector3d p_B =
      v_B * dt - fall_B + m.alpha + R_turn * T_BS.p - T_BS.p;  // of S, axes of B at the start
  const Vector3d p_end = R_turn.transpose() * p_B;             // axes of B at the end

  UncertainTwist twist;
  twist.v_S = R_SB * p_end / dt;
  twist.omega_S = R_SB * quaternion_log(m.gamma) / dt;

  // d [p_end, rotation (axes of B at the end)] by the increments and by the state.
  Eigen::Matrix<double, 6, 15> by_increment = Eigen::Matrix<double, 6, 15>::Zero();
  by_increment.block<3, 3>(0, kAlpha) = R_turn.transpose();
  by_increment.block<3, 3>(0, kTheta) = skew(p_end) - skew(T_BS.p);
  by_increment.block<3, 3>(3, kTheta).setIdentity();
  Eigen::Matrix<double, 6, 15> by_state = Eigen::Matrix<double, 6, 15>::Zero();
  by_state.block<3, 3>(0, kR) = R_turn.transpose() * skew(v_B * dt - fall_B);
  by_state.block<3, 3>(0, kV) = R_turn.transpose() * R_BW * dt;
  by_state.rightCols<6>() = by_increment * imu.jacobian().rightCols<6>();
  const Eigen::Matrix<double, 6, 6> moved = by_state * known.covariance * by_state.transpose() +
                                            by_increment * imu.covariance() * by_increment.transpose();
  Eigen::Matrix<double, 6, 6> to_S = Eigen::Matrix<double, 6, 6>::Zero();
  to_S.topLeftCorner<3, 3>() = R_SB / dt;
  to_S.bottomRightCorner<3, 3>() = R_SB / dt;
  twist.covariance = to_S * moved * to_S.transpose();
  return twist;
}

}  // namespace cosight::vins
