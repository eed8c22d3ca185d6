#pragma once

#include <filesystem>
#include <string>

#include "shared/config/config.hpp"
#include "shared/dataset/agent_input.hpp"
#include "shared/dataset/paced_replay.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::wearable {

/// config/wearable.yaml says what each key is for and when to change it.
struct WearableOptions {
  std::string agent_id = "wearer";
  InputOptions input;
  ReplayOptions replay;
  transport::ParticipantOptions dds;
  double wait_for_robot = 0.0;    ///< before the first frame [s]; 0: does not wait
  double listen_for_twin = 0.5;   ///< before the first frame, for another agent with this id [s]
  std::filesystem::path summary;  ///< a yaml file with the figures of the run; empty: none
};

/// Throws ConfigError.
WearableOptions read_wearable_options(const ConfigNode& root);

}  // namespace cosight::wearable
