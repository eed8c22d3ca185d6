#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <vector>

#include "robot_agent/vins/imu.hpp"
#include "robot_agent/vins/nav_state.hpp"

namespace cosight::vins {

/// Motion between two instants k and k+1 as the IMU alone saw it, free of gravity and of the start (V7-V9):
/// with g_W = [0 0 g] pointing up, as an accelerometer at rest reads it,
///
///   p_k+1 = p_k + v_k dt - g_W dt^2 / 2 + R_k alpha,   v_k+1 = v_k - g_W dt + R_k beta,   q_k+1 = q_k gamma.
struct MotionIncrement {
  Eigen::Vector3d alpha = Eigen::Vector3d::Zero();            ///< [m], axes of B_k
  Eigen::Vector3d beta = Eigen::Vector3d::Zero();             ///< [m/s], axes of B_k
  Eigen::Quaterniond gamma = Eigen::Quaterniond::Identity();  ///< R_{B_k B_k+1}
};

/// IMU samples between two frames, integrated by the midpoint rule once for the biases they were thought to
/// have; small changes of the biases move the result by first order, large ones need repropagate().
class Preintegration {
 public:
  /// Order of the error state, its covariance and its transition.
  enum Offset { kAlpha = 0, kTheta = 3, kBeta = 6, kAccelerometerBias = 9, kGyroscopeBias = 12, kDim = 15 };
  using Matrix = Eigen::Matrix<double, kDim, kDim>;

  /// At least two samples, the first at frame k and the last at frame k+1.
  Preintegration(std::vector<ImuSample> samples, const ImuBias& bias, const ImuNoise& noise);

  /// Goes on to a later frame; the first sample of `next` repeats this one's last.
  void append(const Preintegration& next);

  /// Integrates the same samples again for other biases.
  void repropagate(const ImuBias& bias);

  /// The increment for biases near bias(), by first order.
  MotionIncrement corrected(const ImuBias& bias) const;

  /// Where `state` gets to with this increment and its own biases; the biases stay.
  NavState propagate(const NavState& state, double gravity) const;

  double duration() const { return duration_; }  ///< [s]
  const ImuBias& bias() const { return bias_; }
  const MotionIncrement& increment() const { return increment_; }
  /// Of [alpha, theta (axes of B_k+1), beta, accelerometer bias, gyroscope bias] (V9).
  const Matrix& covariance() const { return covariance_; }
  /// d error state at k+1 / d error state at k; its bias columns are the bias Jacobians.
  const Matrix& jacobian() const { return jacobian_; }
  const std::vector<ImuSample>& samples() const { return samples_; }

 private:
  void step(const ImuSample& from, const ImuSample& to);

  std::vector<ImuSample> samples_;
  ImuBias bias_;
  ImuNoise noise_;
  double duration_ = 0.0;
  MotionIncrement increment_;
  Matrix jacobian_ = Matrix::Identity();
  Matrix covariance_ = Matrix::Zero();
};

}  // namespace cosight::vins
