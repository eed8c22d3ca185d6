#pragma once

#include "robot_agent/vins/nav_state.hpp"
#include "robot_agent/vins/window_odometry.hpp"

namespace cosight::vins {

enum class Failure {
  kNone,
  kSolverFailed,    ///< no usable solution
  kLostTracks,      ///< hardly any feature of the frame before was found again
  kImpossibleBias,  ///< no working IMU has one so large
  kImuGap,          ///< no IMU sample for too long: what it would have said is not known
  kTooFast,         ///< faster than what carries it can go
  kWrongScale,      ///< others have measured quite other distances
  kJumped,          ///< moved or turned against the IMU's prediction farther than it can be wrong
};
const char* to_string(Failure failure);

struct FailureOptions {
  int min_tracked = 5;                  ///< features
  double max_blind = 1.0;               ///< with fewer of them, by the IMU alone [s]
  double max_accelerometer_bias = 2.5;  ///< [m/s^2]
  double max_gyroscope_bias = 1.0;      ///< [rad/s]
  double max_speed = 60.0;              ///< [m/s]
  double max_position_jump = 3.0;       ///< from the prediction [m]
  double max_rotation_jump = 0.5;       ///< likewise [rad]
  double max_imu_gap = 0.1;             ///< [s] without a sample; longer ones are not bridged
};

/// Whether the newest state can be believed.
Failure detect_failure(const WindowReport& report, const FailureOptions& options);

}  // namespace cosight::vins
