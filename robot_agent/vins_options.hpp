#pragma once

#include "robot_agent/vins/vins_thread.hpp"
#include "shared/config/config.hpp"
#include "shared/dataset/agent_input.hpp"

namespace cosight::robot {

/// The section `vins` of the configuration, but for `enable`. Throws ConfigError.
vins::VinsThreadOptions read_vins_options(const ConfigNode& node);

/// For the camera as the input describes it: pixels are its own. Throws ConfigError when there is no IMU, or
/// nobody says where the camera sits in its body.
vins::VinsThreadOptions for_input(vins::VinsThreadOptions options, const AgentInput& input);

}  // namespace cosight::robot
