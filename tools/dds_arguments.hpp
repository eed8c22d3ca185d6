#pragma once

#include <CLI/CLI.hpp>

#include "shared/transport/participant.hpp"

namespace cosight {

/// --domain, --interface, --peer, --dds-profile: how a command takes part in the domain.
void add_dds_options(CLI::App& command, transport::ParticipantOptions& options);

}  // namespace cosight
