#pragma once

#include <Eigen/Core>

#include "robot_agent/vins/preintegration.hpp"
#include "shared/geometry/uncertain_twist.hpp"

namespace cosight::vins {

/// A state and how surely it is known.
struct UncertainNavState {
  Stamp stamp = 0;
  NavState state;
  /// Of [dp (W), dtheta (B), dv (W), d accelerometer bias, d gyroscope bias], as state_covariance() gives it.
  Eigen::Matrix<double, 15, 15> covariance = Eigen::Matrix<double, 15, 15>::Zero();

  // Where its parts begin.
  static constexpr int kPosition = 0;
  static constexpr int kRotation = 3;
  static constexpr int kVelocity = 6;
  static constexpr int kAccelerometerBias = 9;
  static constexpr int kGyroscopeBias = 12;
};

/// Where the IMU alone leads from `known`. `imu` begins at its stamp.
UncertainNavState led_by_imu(const UncertainNavState& known, const Preintegration& imu, double gravity);

/// Mean twist of the camera over the span of `imu`, which begins at `known`, in the camera's axes at its end:
///
///   p_S0S1 = R_SB (v_B dt - R_WB^T g_W dt^2 / 2 + alpha + (gamma - I) p_BS),   q_S0S1 = q_SB gamma q_BS,
///   v_S = R_S0S1^T p_S0S1 / dt,   omega_S = log(q_S0S1) / dt.
///
/// Nothing of the images at its end is in it.
UncertainTwist mean_twist(const UncertainNavState& known, const Preintegration& imu, const Pose& T_BS,
                          double gravity);

}  // namespace cosight::vins
