#include "robot_agent/vins_plan.hpp"

namespace cosight::robot {

std::optional<vins::VinsThreadOptions> plan_vins(const RobotOptions& options, const AgentInput& input) {
  if (!has_vins(options.estimators)) return std::nullopt;
  if (!input.has_imu) {
    throw ConfigError("vins.enable: needs the robot's IMU; give input.imu, or a dataset with robot/imu.csv");
  }
  if (!input.T_BS) {
    throw ConfigError(
        "vins.enable: needs to know where the camera sits; give a calibration with T_BC (the camera in the "
        "IMU's body, 4x4)");
  }
  vins::VinsThreadOptions plan = options.vins;
  plan.vins.window.solver.graph.trust.focal_length = 0.5 * (input.camera.fx + input.camera.fy);
  // What is read from a file can wait until VINS is done with it; what is live, or pretends to be, can't.
  const bool is_recorded = !options.input.recording.empty();
  plan.never_drop = is_recorded || (!input.live && options.replay.rate <= 0.0);
  return plan;
}

}  // namespace cosight::robot
