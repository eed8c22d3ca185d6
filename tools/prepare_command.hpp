#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight prepare NAME --data DIR --out DIR …`: a real sequence as a Cosight dataset folder for two agents.
void add_prepare_command(CLI::App& program);

}  // namespace cosight
