#pragma once

#include <optional>

#include "robot_agent/options.hpp"

namespace cosight::robot {

/// VINS for the camera as the input describes it; nothing when it is not to run. Throws ConfigError when
/// there is no IMU, or nobody says where the camera sits in the IMU's body.
std::optional<vins::VinsThreadOptions> plan_vins(const RobotOptions& options, const AgentInput& input);

}  // namespace cosight::robot
