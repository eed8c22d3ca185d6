#pragma once

#include <optional>

#include "robot_agent/intake.hpp"
#include "robot_agent/options.hpp"

namespace cosight::robot {

/// Nothing when a tracker says where the wearer is, or nobody does.
std::optional<LocatorPlan> plan_locator(const RobotOptions& options, const AgentInput& input);

}  // namespace cosight::robot
