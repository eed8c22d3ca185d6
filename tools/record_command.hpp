#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight record FILE.mcap`: everything that is said in the DDS domain, until Ctrl-C.
void add_record_command(CLI::App& program);

}  // namespace cosight
