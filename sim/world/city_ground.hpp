#pragma once

#include <cstdint>
#include <vector>

#include "sim/city/streets.hpp"
#include "sim/world/lighting.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// The streets' asphalt, pavements and marks at height `z` [m], in square tiles without overlaps.
void lay_ground(Scene& scene, const std::vector<Street>& streets, double z, const Lighting& lighting,
                std::uint64_t seed);

}  // namespace cosight::sim
