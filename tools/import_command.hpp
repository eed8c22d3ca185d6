#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight import DATASET FILE.mcap`: a Cosight dataset folder as a recording.
void add_import_command(CLI::App& program);

}  // namespace cosight
