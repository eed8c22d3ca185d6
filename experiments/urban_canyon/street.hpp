#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "sim/city/route.hpp"

namespace cosight::experiments {

using sim::Route;

/// A corner of something that stands still, and the stretch of the route from which it can be seen.
struct StreetPoint {
  Eigen::Vector3d p_W;
  double from = 0.0, to = 0.0;  ///< distance driven [m]
};

/// Fronts of houses on both sides and at the end of each street, things on the kerb, marks on the road,
/// towers behind. Sorted by `from`.
std::vector<StreetPoint> make_street(const Route& route, std::mt19937_64& random);

}  // namespace cosight::experiments
