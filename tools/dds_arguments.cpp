#include "tools/dds_arguments.hpp"

namespace cosight {

void add_dds_options(CLI::App& command, transport::ParticipantOptions& options) {
  command.add_option("--domain", options.domain, "DDS domain")
      ->check(CLI::Range(0, 232))
      ->capture_default_str();
  command.add_option("--interface", options.interfaces, "network interface by name or IPv4; default: all");
  command.add_option("--peer", options.peers, "IPv4 address to ask besides multicast");
  command.add_option("--dds-profile", options.profile_file, "Fast DDS XML profiles")
      ->check(CLI::ExistingFile);
}

}  // namespace cosight
