#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight compare`: runs on the same data against the first of them.
void add_compare_command(CLI::App& program);

}  // namespace cosight
