#pragma once

#include "shared/config/config.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::transport {

/// The section `dds` of an agent's configuration; what is absent stays as in `defaults`. Throws ConfigError.
ParticipantOptions read_participant_options(const ConfigNode& node, ParticipantOptions defaults);

}  // namespace cosight::transport
