#pragma once

#include <cstdint>
#include <vector>

#include "sim/city/streets.hpp"
#include "sim/world/lighting.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// How a city looks.
struct CityPlan {
  bool night = false;           ///< street lamps and lit windows instead of daylight
  double lowest_house = 13.0;   ///< [m]
  double highest_house = 26.0;  ///< [m]
  double front_texel = 0.04;    ///< finest detail of the houses [m]
  double parked_share = 0.45;   ///< of the places at the kerb
  double lamp_spacing = 28.0;   ///< on either side in turn [m]
};

/// All that stands still in a city, and its light.
struct City {
  Scene scene;
  Lighting lighting;
};

/// Houses along the border of the streets, pavements, lamp posts, parked cars, towers behind, sky. The same
/// streets and seed give the same city. `ground`: height of the streets [m].
City build_city(const std::vector<Street>& streets, const CityPlan& plan, double ground, std::uint64_t seed);

}  // namespace cosight::sim
