#include "wearable_agent/options.hpp"

namespace cosight::wearable {
namespace {

transport::ParticipantOptions read_dds_options(const ConfigNode& node) {
  transport::ParticipantOptions options;
  options.name = "cosight_wearable";
  options.domain = node.integer("domain", options.domain, 0, 232);
  options.profile_file = node.path("profile_file", options.profile_file).string();
  options.shared_memory = node.boolean("shared_memory", options.shared_memory);
  options.interfaces = node.texts("interfaces", options.interfaces);
  options.peers = node.texts("peers", options.peers);
  options.max_message_size = node.integer("max_message_size", options.max_message_size, 256, 65500);
  options.max_bytes_per_second = node.number("max_bytes_per_second", options.max_bytes_per_second, 0.0, 1e10);
  options.socket_buffer = node.integer("socket_buffer", options.socket_buffer, 65536, 1 << 28);
  return options;
}

}  // namespace

WearableOptions read_wearable_options(const ConfigNode& root) {
  WearableOptions options;
  options.agent_id = root.text("agent_id", options.agent_id);
  options.input = read_input_options(root.section("input"), Agent::kWearer);
  const ConfigNode replay = root.section("replay");
  options.replay.rate = replay.number("rate", options.replay.rate, 0.0, 1000.0);
  options.replay.loop = replay.boolean("loop", options.replay.loop);
  options.dds = read_dds_options(root.section("dds"));
  const ConfigNode start = root.section("start");
  options.wait_for_robot = start.number("wait_for_robot", options.wait_for_robot, 0.0, 86'400.0);
  options.listen_for_twin = start.number("listen_for_twin", options.listen_for_twin, 0.0, 60.0);
  options.summary = root.path("summary", options.summary);
  return options;
}

}  // namespace cosight::wearable
