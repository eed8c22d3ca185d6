#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight info FILE.mcap`: what is in a recording, whoever made it.
void add_info_command(CLI::App& program);

}  // namespace cosight
