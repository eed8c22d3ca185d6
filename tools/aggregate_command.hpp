#pragma once

namespace CLI {
class App;
}

namespace cosight {

/// `cosight aggregate`: many evaluated runs, each in several modes, as one table and one summary.json.
void add_aggregate_command(CLI::App& program);

}  // namespace cosight
