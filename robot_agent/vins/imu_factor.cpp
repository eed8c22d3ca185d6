#include "robot_agent/vins/imu_factor.hpp"

#include <Eigen/Cholesky>
#include <cmath>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using PoseJacobian = Eigen::Matrix<double, 15, 7, Eigen::RowMajor>;
using MotionJacobian = Eigen::Matrix<double, 15, 9, Eigen::RowMajor>;

constexpr int kAlpha = Preintegration::kAlpha;
constexpr int kTheta = Preintegration::kTheta;
constexpr int kBeta = Preintegration::kBeta;
constexpr int kBa = Preintegration::kAccelerometerBias;
constexpr int kBg = Preintegration::kGyroscopeBias;

/// Upper triangular U with U^T U = covariance^-1.
Preintegration::Matrix sqrt_information(const Preintegration::Matrix& covariance) {
  const Preintegration::Matrix information = covariance.llt().solve(Preintegration::Matrix::Identity());
  return information.llt().matrixU();
}

/// d Exp(phi + d) = Exp(phi) Exp(J_r d): J_r to second order; phi is a bias step times a few tenths of a
/// second.
Matrix3d right_jacobian(const Vector3d& phi) {
  const Matrix3d K = skew(phi);
  return Matrix3d::Identity() - 0.5 * K + K * K / 6.0;
}

/// The quantities that the residual and its Jacobians share.
struct Relation {
  double dt;
  Matrix3d R_i_T;
  Vector3d moved;        ///< R_i^T (p_j - p_i - v_i dt + g dt^2/2)
  Vector3d accelerated;  ///< R_i^T (v_j - v_i + g dt)
  MotionIncrement measured;
  Eigen::Quaterniond q_error;  ///< gamma^-1 q_i^-1 q_j, w >= 0
};

void fill_pose_i(const Relation& x, PoseJacobian& J) {
  const Matrix3d E = x.q_error.w() * Matrix3d::Identity() - skew(x.q_error.vec());
  J.setZero();
  J.block<3, 3>(kAlpha, 0) = -x.R_i_T;
  J.block<3, 3>(kAlpha, 3) = skew(x.moved);
  J.block<3, 3>(kTheta, 3) = -E * x.measured.gamma.toRotationMatrix().transpose();
  J.block<3, 3>(kBeta, 3) = skew(x.accelerated);
}

void fill_motion_i(const Relation& x, const Preintegration& imu, const Vector3d& d_bg, MotionJacobian& J) {
  const auto& bias = imu.jacobian();
  const Matrix3d E = x.q_error.w() * Matrix3d::Identity() - skew(x.q_error.vec());
  const Matrix3d theta_bg = bias.block<3, 3>(kTheta, kBg);
  J.setZero();
  J.block<3, 3>(kAlpha, 0) = -x.dt * x.R_i_T;
  J.block<3, 6>(kAlpha, 3) = -bias.block<3, 6>(kAlpha, kBa);
  J.block<3, 3>(kTheta, 6) = -E * right_jacobian(theta_bg * d_bg) * theta_bg;
  J.block<3, 3>(kBeta, 0) = -x.R_i_T;
  J.block<3, 6>(kBeta, 3) = -bias.block<3, 6>(kBeta, kBa);
  J.block<6, 6>(kBa, 3) = -Eigen::Matrix<double, 6, 6>::Identity();
}

void fill_pose_j(const Relation& x, PoseJacobian& J) {
  J.setZero();
  J.block<3, 3>(kAlpha, 0) = x.R_i_T;
  J.block<3, 3>(kTheta, 3) = x.q_error.w() * Matrix3d::Identity() + skew(x.q_error.vec());
}

void fill_motion_j(const Relation& x, MotionJacobian& J) {
  J.setZero();
  J.block<3, 3>(kBeta, 0) = x.R_i_T;
  J.block<6, 6>(kBa, 3).setIdentity();
}

Relation relate(const NavState& i, const NavState& j, const Preintegration& imu, const Vector3d& g_W) {
  Relation x;
  x.dt = imu.duration();
  x.R_i_T = i.T_WB.q.toRotationMatrix().transpose();
  x.moved = x.R_i_T * (j.T_WB.p - i.T_WB.p - i.v_W * x.dt + 0.5 * x.dt * x.dt * g_W);
  x.accelerated = x.R_i_T * (j.v_W - i.v_W + g_W * x.dt);
  x.measured = imu.corrected(i.bias);
  x.q_error = x.measured.gamma.conjugate() * i.T_WB.q.conjugate() * j.T_WB.q;
  if (x.q_error.w() < 0.0) x.q_error.coeffs() *= -1.0;
  return x;
}

}  // namespace

ImuFactor::ImuFactor(const Preintegration& imu, double gravity)
    : imu_(imu), g_W_(0.0, 0.0, gravity), sqrt_information_(sqrt_information(imu.covariance())) {}

bool ImuFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  const NavState i = to_state(parameters[0], parameters[1]);
  const NavState j = to_state(parameters[2], parameters[3]);
  const Relation x = relate(i, j, imu_, g_W_);

  Eigen::Matrix<double, 15, 1> r;
  r << x.moved - x.measured.alpha, 2.0 * x.q_error.vec(), x.accelerated - x.measured.beta,
      j.bias.accelerometer - i.bias.accelerometer, j.bias.gyroscope - i.bias.gyroscope;
  const auto U = sqrt_information_.triangularView<Eigen::Upper>();
  Eigen::Map<Eigen::Matrix<double, 15, 1>>(residuals).noalias() = U * r;
  if (jacobians == nullptr) return true;

  PoseJacobian J_pose;
  MotionJacobian J_motion;
  if (jacobians[0] != nullptr) {
    fill_pose_i(x, J_pose);
    Eigen::Map<PoseJacobian>(jacobians[0]).noalias() = U * J_pose;
  }
  if (jacobians[1] != nullptr) {
    fill_motion_i(x, imu_, i.bias.gyroscope - imu_.bias().gyroscope, J_motion);
    Eigen::Map<MotionJacobian>(jacobians[1]).noalias() = U * J_motion;
  }
  if (jacobians[2] != nullptr) {
    fill_pose_j(x, J_pose);
    Eigen::Map<PoseJacobian>(jacobians[2]).noalias() = U * J_pose;
  }
  if (jacobians[3] != nullptr) {
    fill_motion_j(x, J_motion);
    Eigen::Map<MotionJacobian>(jacobians[3]).noalias() = U * J_motion;
  }
  return true;
}

}  // namespace cosight::vins
