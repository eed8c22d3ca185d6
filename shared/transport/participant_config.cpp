#include "shared/transport/participant_config.hpp"

namespace cosight::transport {

ParticipantOptions read_participant_options(const ConfigNode& node, ParticipantOptions defaults) {
  ParticipantOptions options = std::move(defaults);
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

}  // namespace cosight::transport
