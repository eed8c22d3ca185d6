#pragma once

#include <CLI/CLI.hpp>

namespace cosight {

/// `cosight evaluate ESTIMATE TRUTH …`: a run against its truth, as table, csv, json and picture.
void add_evaluate_command(CLI::App& program);

}  // namespace cosight
