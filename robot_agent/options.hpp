#pragma once

#include <filesystem>
#include <string>

#include "robot_agent/estimators.hpp"
#include "robot_agent/inbox/options.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/vins_options.hpp"
#include "robot_agent/wearer_options.hpp"
#include "shared/config/config.hpp"
#include "shared/dataset/agent_input.hpp"
#include "shared/dataset/paced_replay.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::robot {

/// config/robot.yaml says what each key is for and when to change it.
struct RobotOptions {
  std::string agent_id = "robot";
  InputOptions input;
  ReplayOptions replay;
  transport::ParticipantOptions dds;
  inbox::InboxOptions inbox;
  slam::SlamOptions slam;
  WearerSection wearer;
  Estimators estimators = Estimators::kSlam;
  vins::VinsThreadOptions vins;
  VinsHelp vins_help;
  double wait_for_wearer = 10.0;   ///< before the first frame [s]; then the robot goes on alone
  double wait_for_sensors = 60.0;  ///< whose calibration only their topic tells [s]
  std::filesystem::path run_dir = "runs/robot";
};

/// Throws ConfigError.
RobotOptions read_robot_options(const ConfigNode& root);

}  // namespace cosight::robot
