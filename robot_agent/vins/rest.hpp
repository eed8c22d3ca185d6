#pragma once

#include <deque>
#include <optional>

#include "robot_agent/vins/gyroscope_bias.hpp"
#include "robot_agent/vins/sliding_window.hpp"

namespace cosight::vins {

/// A moment at which the body stood still, and what its IMU said meanwhile, on average.
struct Rest {
  Stamp stamp = 0;                                    ///< of a frame in the middle of the rest
  Eigen::Vector3d force_B = Eigen::Vector3d::Zero();  ///< [m/s^2]: up, and the accelerometer's bias
  Eigen::Vector3d angular_velocity_B = Eigen::Vector3d::Zero();  ///< [rad/s]: the gyroscope's bias
};

struct RestOptions {
  double max_motion = 1.0 / 460.0;  ///< of the median feature between the first and the last frame [rad]
  std::size_t min_features = 20;    ///< seen in both
  double max_age = 5.0;             ///< so long a rest is remembered [s]; the IMU's errors grow with time
  double velocity = 0.02;           ///< what may be left of it, standard deviation [m/s]
  double force = 0.02;              ///< of the mean force [m/s^2]
  double angular_velocity = 2e-3;   ///< of the mean rate [rad/s]
};

/// Nothing unless the features stood still over all of the frames.
std::optional<Rest> find_rest(const std::deque<UnplacedFrame>& frames, const RestOptions& options);

/// q_WB of a body that feels `up_B` as up and looks along x of W.
Eigen::Quaterniond levelled(const Eigen::Vector3d& up_B);

/// State of the frame at rest: no velocity, z of W along the force, heading zero, biases as the IMU tells
/// them. `gravity` in m/s^2.
NavState state_at(const Rest& rest, double gravity);

/// What is known of it. The force does not tell tilt from accelerometer bias, only both together; that is
/// what keeps the speed right for seconds of motion. `otherwise`: of what a rest does not tell.
Prior rest_prior(const WindowFrame& first, const RestOptions& options, const StartUncertainty& otherwise,
                 double gravity);

}  // namespace cosight::vins
