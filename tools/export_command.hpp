#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight export FILE.mcap --euroc DIR | --tum DIR | --images DIR`: data out of a recording, for other
/// programs.
void add_export_command(CLI::App& program);

}  // namespace cosight
