#include "robot_agent/ekf/motion.hpp"

#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

constexpr int kR = CameraState::kPosition;
constexpr int kQ = CameraState::kOrientation;
constexpr int kV = CameraState::kVelocity;
constexpr int kOmega = CameraState::kAngularVelocity;

}  // namespace

CameraState::Covariance MotionStep::F() const {
  CameraState::Covariance f = CameraState::Covariance::Identity();
  f.block<3, 3>(kR, kV) = dt * Eigen::Matrix3d::Identity();
  f.block<4, 4>(kQ, kQ) = q_q;
  f.block<4, 3>(kQ, kOmega) = q_omega;
  return f;
}

MotionStep predict_motion(const CameraState& x, double dt, const MotionNoise& noise) {
  MotionStep step;
  const Eigen::Quaterniond turn = quaternion_exp(x.omega_S * dt);
  step.dt = dt;
  step.x = x;
  step.x.r_WS += x.v_W * dt;
  step.x.q_WS = x.q_WS * turn;
  step.q_q = right_product_matrix(turn);
  step.q_omega = left_product_matrix(x.q_WS) * quaternion_exp_jacobian(x.omega_S * dt) * dt;

  Eigen::Matrix<double, CameraState::kDim, 6> G = Eigen::Matrix<double, CameraState::kDim, 6>::Zero();
  G.block<3, 3>(kR, 0) = dt * Eigen::Matrix3d::Identity();
  G.block<3, 3>(kV, 0).setIdentity();
  G.block<4, 3>(kQ, 3) = step.q_omega;
  G.block<3, 3>(kOmega, 3).setIdentity();
  Eigen::Matrix<double, 6, 1> sigma;
  sigma.head<3>().setConstant(noise.sigma_acceleration * dt);
  sigma.tail<3>().setConstant(noise.sigma_angular_acceleration * dt);
  const Eigen::Matrix<double, CameraState::kDim, 6> scaled = G * sigma.asDiagonal();
  step.process_noise = scaled * scaled.transpose();
  return step;
}

}  // namespace cosight::ekf
