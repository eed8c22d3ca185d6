#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "sim/sensors/inertial.hpp"
#include "sim/sensors/sensor_clock.hpp"

namespace cosight::sim {

/// An inertial sensor; of the Xsens MTi-10's class by default.
struct ImuPlan {
  TimingPlan timing{.rate = 200.0};
  Pose T_BI{};                             ///< where it sits in the body
  double gyro_density = 5.2e-4;            ///< [rad/s/sqrt(Hz)]
  double gyro_bias = 3.5e-3;               ///< deviation of the bias at the start [rad/s]
  double gyro_bias_wander = 8.7e-5;        ///< deviation of its changes in a run [rad/s]
  double acceleration_density = 5.9e-4;    ///< [m/s^2/sqrt(Hz)]
  double acceleration_bias = 0.03;         ///< [m/s^2]
  double acceleration_bias_wander = 4e-4;  ///< [m/s^2]
  double wander_time = 100.0;              ///< over which the biases change [s]
};

/// A measurement as `w + b_w + n_w` and `a + R^T g + b_a + n_a` (V4), and the biases in it.
struct BiasedImuSample {
  ImuSample measured;
  Eigen::Vector3d gyro_bias;          ///< truth [rad/s]
  Eigen::Vector3d acceleration_bias;  ///< truth [m/s^2]
};

std::vector<BiasedImuSample> simulate_imu(const ImuPlan& plan, const Motion& T_WB, double duration,
                                          std::uint64_t seed);

}  // namespace cosight::sim
