#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight summarise DIR MODE…`: gathers DIR/MODE/evaluation.json and the programs' own summaries into
/// DIR/summary.json (mode -> metric -> number), one picture of all modes, and a table.
void add_summarise_command(CLI::App& program);

}  // namespace cosight
