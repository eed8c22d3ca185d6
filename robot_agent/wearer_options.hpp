#pragma once

#include "robot_agent/wearer/options.hpp"
#include "shared/config/config.hpp"
#include "shared/dataset/agent_input.hpp"

namespace cosight::robot {

/// Who says where the wearer is.
enum class WearerPoseFrom {
  kAuto,     ///< the input or a topic when there is one with poses, else the lasers when there are any
  kTracker,  ///< the input, else the topic
  kLaser,    ///< the lasers, whatever else there is
};

/// The section `wearer` of the configuration.
struct WearerSection {
  WearerPoseFrom pose_from = WearerPoseFrom::kAuto;
  wearer::WearerOptions tracking;
};

/// Throws ConfigError.
WearerSection read_wearer_section(const ConfigNode& node);

/// With the lasers and the camera as the input says that they are mounted. Throws ConfigError when it does
/// not say enough.
wearer::WearerOptions with_mountings(wearer::WearerOptions options, const AgentInput& input);

}  // namespace cosight::robot
