#pragma once

#include "robot_agent/slam/options.hpp"
#include "shared/config/config.hpp"

namespace cosight {

/// The section `slam` of config/robot.yaml; an absent key keeps its default.
slam::SlamOptions read_slam_options(const ConfigNode& node);

}  // namespace cosight
