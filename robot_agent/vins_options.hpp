#pragma once

#include "robot_agent/vins/vins_thread.hpp"
#include "shared/config/config.hpp"

namespace cosight::robot {

/// The section `vins` of the configuration, but for `enable`. Throws ConfigError.
vins::VinsThreadOptions read_vins_options(const ConfigNode& node);

}  // namespace cosight::robot
