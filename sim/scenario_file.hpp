#pragma once

#include "shared/config/config.hpp"
#include "sim/scenario.hpp"

namespace cosight::sim {

/// Reads a scene file as in config/scenes/: keys that end in _deg in degrees, everything else in SI units.
/// Throws ConfigError.
Scenario read_scenario(const ConfigNode& root);

}  // namespace cosight::sim
