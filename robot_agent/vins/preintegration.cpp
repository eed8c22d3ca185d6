#include "robot_agent/vins/preintegration.hpp"

#include <cassert>
#include <utility>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Transition = Preintegration::Matrix;
using Eigen::Matrix3d;
using Eigen::Vector3d;

constexpr int kAlpha = Preintegration::kAlpha;
constexpr int kTheta = Preintegration::kTheta;
constexpr int kBeta = Preintegration::kBeta;
constexpr int kBa = Preintegration::kAccelerometerBias;
constexpr int kBg = Preintegration::kGyroscopeBias;

/// One midpoint step: rates at both ends without bias, rotations before and after.
struct Midpoint {
  double dt;
  Vector3d omega;     ///< mean rate [rad/s]
  Vector3d a_0, a_1;  ///< specific force in B at either end [m/s^2]
  Matrix3d R_0, R_1;  ///< R_{B_k B} before and after
};

/// Transition of the error state [alpha theta beta ba bg] over one midpoint step. `theta` turns on the right.
Transition transition(const Midpoint& m) {
  const double dt = m.dt;
  const Matrix3d turn = Matrix3d::Identity() - skew(m.omega) * dt;
  const Matrix3d Ra_0 = m.R_0 * skew(m.a_0);
  const Matrix3d Ra_1 = m.R_1 * skew(m.a_1);
  const Matrix3d beta_theta = -0.5 * dt * (Ra_0 + Ra_1 * turn);
  const Matrix3d beta_ba = -0.5 * dt * (m.R_0 + m.R_1);
  const Matrix3d beta_bg = 0.5 * dt * dt * Ra_1;
  Transition F = Transition::Identity();
  F.block<3, 3>(kAlpha, kTheta) = 0.5 * dt * beta_theta;
  F.block<3, 3>(kAlpha, kBeta) = dt * Matrix3d::Identity();
  F.block<3, 3>(kAlpha, kBa) = 0.5 * dt * beta_ba;
  F.block<3, 3>(kAlpha, kBg) = 0.5 * dt * beta_bg;
  F.block<3, 3>(kTheta, kTheta) = turn;
  F.block<3, 3>(kTheta, kBg) = -dt * Matrix3d::Identity();
  F.block<3, 3>(kBeta, kTheta) = beta_theta;
  F.block<3, 3>(kBeta, kBa) = beta_ba;
  F.block<3, 3>(kBeta, kBg) = beta_bg;
  return F;
}

/// Covariance that the white noise and the bias walks add over one step. The noise of one sample has the
/// variance density^2 / dt and enters like minus the bias; neighbouring steps share a sample, so the mean of
/// both ends keeps the variance of one.
Transition step_noise(const Midpoint& m, const Transition& F, const ImuNoise& noise) {
  const double dt = m.dt;
  const auto G_a = F.middleCols<3>(kBa).topRows<9>();
  const auto G_g = F.middleCols<3>(kBg).topRows<9>();
  Transition Q = Transition::Zero();
  Q.topLeftCorner<9, 9>() = G_a * G_a.transpose() * (noise.accelerometer * noise.accelerometer / dt) +
                            G_g * G_g.transpose() * (noise.gyroscope * noise.gyroscope / dt);
  Q.diagonal().segment<3>(kBa).setConstant(noise.accelerometer_walk * noise.accelerometer_walk * dt);
  Q.diagonal().segment<3>(kBg).setConstant(noise.gyroscope_walk * noise.gyroscope_walk * dt);
  return Q;
}

}  // namespace

Preintegration::Preintegration(std::vector<ImuSample> samples, const ImuBias& bias, const ImuNoise& noise)
    : samples_(std::move(samples)), bias_(bias), noise_(noise) {
  assert(samples_.size() >= 2);
  repropagate(bias);
}

void Preintegration::append(const Preintegration& next) {
  assert(next.samples_.front().stamp == samples_.back().stamp);
  for (std::size_t i = 1; i < next.samples_.size(); ++i) {
    step(samples_.back(), next.samples_[i]);
    samples_.push_back(next.samples_[i]);
  }
}

void Preintegration::repropagate(const ImuBias& bias) {
  bias_ = bias;
  duration_ = 0.0;
  increment_ = {};
  jacobian_.setIdentity();
  covariance_.setZero();
  for (std::size_t i = 1; i < samples_.size(); ++i)
    step(samples_[i - 1], samples_[i]);
}

void Preintegration::step(const ImuSample& from, const ImuSample& to) {
  Midpoint m;
  m.dt = to_seconds(to.stamp - from.stamp);
  m.omega = 0.5 * (from.angular_velocity_B + to.angular_velocity_B) - bias_.gyroscope;
  m.a_0 = from.acceleration_B - bias_.accelerometer;
  m.a_1 = to.acceleration_B - bias_.accelerometer;
  const Eigen::Quaterniond gamma_1 = (increment_.gamma * quaternion_exp(m.omega * m.dt)).normalized();
  m.R_0 = increment_.gamma.toRotationMatrix();
  m.R_1 = gamma_1.toRotationMatrix();

  const Vector3d a = 0.5 * (m.R_0 * m.a_0 + m.R_1 * m.a_1);
  increment_.alpha += increment_.beta * m.dt + 0.5 * m.dt * m.dt * a;
  increment_.beta += a * m.dt;
  increment_.gamma = gamma_1;
  duration_ += m.dt;

  const Transition F = transition(m);
  jacobian_ = (F * jacobian_).eval();
  covariance_ = (F * covariance_ * F.transpose()).eval() + step_noise(m, F, noise_);
}

MotionIncrement Preintegration::corrected(const ImuBias& bias) const {
  const Vector3d d_ba = bias.accelerometer - bias_.accelerometer;
  const Vector3d d_bg = bias.gyroscope - bias_.gyroscope;
  MotionIncrement out;
  out.alpha = increment_.alpha + jacobian_.block<3, 3>(kAlpha, kBa) * d_ba +
              jacobian_.block<3, 3>(kAlpha, kBg) * d_bg;
  out.beta =
      increment_.beta + jacobian_.block<3, 3>(kBeta, kBa) * d_ba + jacobian_.block<3, 3>(kBeta, kBg) * d_bg;
  out.gamma = increment_.gamma * quaternion_exp(jacobian_.block<3, 3>(kTheta, kBg) * d_bg);
  return out;
}

NavState Preintegration::propagate(const NavState& state, double gravity) const {
  const MotionIncrement m = corrected(state.bias);
  const Vector3d g_W(0.0, 0.0, gravity);
  const double dt = duration_;
  NavState next = state;
  next.T_WB.p += state.v_W * dt - 0.5 * dt * dt * g_W + state.T_WB.q * m.alpha;
  next.v_W += -dt * g_W + state.T_WB.q * m.beta;
  next.T_WB.q = (state.T_WB.q * m.gamma).normalized();  // V12: its left side is q_{k+1}
  return next;
}

}  // namespace cosight::vins
