#pragma once

#include "shared/program/program.hpp"

namespace cosight {

/// The options that both agents have: where their input comes from, its pace, and the DDS domain.
Program& add_agent_options(Program& program);

}  // namespace cosight
