#pragma once

#include <filesystem>
#include <vector>

#include "shared/config/config.hpp"
#include "sim/scenario.hpp"

namespace cosight::sim {

/// Reads a scene file as in config/scenes/. Angles in degrees, everything else in SI units. Throws
/// ConfigError.
Scenario load_scenario(const std::filesystem::path& file, const std::vector<ConfigOverride>& overrides = {});

/// The same from a file that has been opened; for tests.
Scenario read_scenario(const ConfigFile& file);

}  // namespace cosight::sim
