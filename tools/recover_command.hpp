#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight recover FILE.mcap OUT.mcap`: a whole file from one that was cut off or damaged, or has no index.
void add_recover_command(CLI::App& program);

}  // namespace cosight
