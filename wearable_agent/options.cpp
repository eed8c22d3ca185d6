#include "wearable_agent/options.hpp"

#include "shared/transport/participant_config.hpp"

namespace cosight::wearable {

WearableOptions read_wearable_options(const ConfigNode& root) {
  WearableOptions options;
  options.agent_id = root.text("agent_id", options.agent_id);
  options.input = read_input_options(root.section("input"), Agent::kWearer);
  const ConfigNode replay = root.section("replay");
  options.replay.rate = replay.number("rate", options.replay.rate, 0.0, 1000.0);
  options.replay.loop = replay.boolean("loop", options.replay.loop);
  options.dds.name = "cosight_wearable";
  options.dds = transport::read_participant_options(root.section("dds"), options.dds);
  const ConfigNode start = root.section("start");
  options.wait_for_robot = start.number("wait_for_robot", options.wait_for_robot, 0.0, 86'400.0);
  options.listen_for_twin = start.number("listen_for_twin", options.listen_for_twin, 0.0, 60.0);
  options.summary = root.path("summary", options.summary);
  return options;
}

}  // namespace cosight::wearable
