#include "robot_agent/locator_plan.hpp"

namespace cosight::robot {

std::optional<LocatorPlan> plan_locator(const RobotOptions& options, const AgentInput& input) {
  using enum WearerPoseFrom;
  if (!has_slam(options.estimators)) return std::nullopt;
  const bool is_auto = options.wearer.pose_from == kAuto;
  const bool can_locate = !input.lasers.empty() && input.T_BS;
  const bool locates = is_auto ? can_locate && !input.has_wearer_pose : options.wearer.pose_from == kLaser;
  if (!locates) return std::nullopt;
  return LocatorPlan{with_mountings(options.wearer.tracking, input),
                     {options.inbox.mounting.yaw_offset, options.slam.yaw_offset.prior.sigma},
                     is_auto};
}

}  // namespace cosight::robot
