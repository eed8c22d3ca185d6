#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight replay FILE.mcap`: sends a recording into the DDS domain again.
void add_replay_command(CLI::App& program);

}  // namespace cosight
