#pragma once

#include "robot_agent/vins/imu.hpp"
#include "robot_agent/vins/imu_motion.hpp"
#include "robot_agent/vins/window.hpp"
#include "shared/transport/samples.hpp"

namespace cosight::robot {

/// The newest state of the window as others read it: the camera's pose and twist with their covariances given
/// everything in the window. The angular velocity is the newest gyroscope sample's.
OdometrySample odometry_of(const vins::Window& window, const vins::UncertainNavState& known,
                           const vins::ImuNoise& noise);

}  // namespace cosight::robot
