#pragma once

#include <cstdint>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "sim/sensors/inertial.hpp"
#include "sim/sensors/sensor_clock.hpp"

namespace cosight::sim {

/// What an attitude and heading reference system gets wrong.
struct AhrsPlan {
  TimingPlan timing{};
  double roll_pitch_sigma = 0.5 * 0.017453292519943295;  ///< [rad]
  double yaw_sigma = 0.017453292519943295;               ///< [rad]
  double wander_time = 10.0;         ///< over which its errors change; they are no white noise [s]
  double white_sigma = 0.0009;       ///< on top of them, per sample [rad]
  double north_offset = 0.0;         ///< yaw of W in the AHRS's own world [rad]
  double disturbance = 0.0;          ///< yaw that magnetic surroundings add at most [rad]
  double disturbance_time = 30.0;    ///< in which it swings once [s]
  double gyro_sigma = 0.003;         ///< [rad/s] per sample
  double acceleration_sigma = 0.02;  ///< [m/s^2] per sample
};

/// What the AHRS on a body says over `duration` [s]. The orientation is that of the body in the AHRS's world.
std::vector<AhrsSample> simulate_ahrs(const AhrsPlan& plan, const Motion& T_WH, double duration,
                                      std::uint64_t seed);

}  // namespace cosight::sim
