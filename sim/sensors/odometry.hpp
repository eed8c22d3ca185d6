#pragma once

#include <cstdint>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "sim/sensors/inertial.hpp"
#include "sim/sensors/sensor_clock.hpp"

namespace cosight::sim {

/// Wheel odometry that adds up what the wheels say; slips and scales are its errors.
struct OdometryPlan {
  TimingPlan timing{.rate = 20.0};
  double scale_sigma = 0.01;       ///< of the wheels' radius, once a run
  double turn_scale_sigma = 0.02;  ///< of the turn, once a run
  double slip = 0.005;             ///< deviation of the way per root of a metre [m/sqrt(m)]
  double turn_slip = 0.01;         ///< deviation of the heading per root of a metre [rad/sqrt(m)]
};

/// O is the frame of the first pose.
std::vector<WheelOdometrySample> simulate_odometry(const OdometryPlan& plan, const Motion& T_WB,
                                                   double duration, std::uint64_t seed);

}  // namespace cosight::sim
