#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/city/route.hpp"
#include "sim/city/traffic.hpp"

namespace cosight::sim {

/// A straight street, along x or y of W, from house to house.
struct Street {
  Eigen::Vector2d start;      ///< middle of its beginning [m]
  Eigen::Vector2d direction;  ///< unit length
  double length = 0.0;        ///< [m]
  double half_width = 0.0;    ///< [m]
  bool main = true;           ///< the route leads along it

  /// A point `along` and `left` of its middle line.
  Eigen::Vector2d at(double along, double left) const {
    return start + along * direction + left * Eigen::Vector2d(-direction.y(), direction.x());
  }
  Eigen::Vector2d low() const { return at(0, -half_width).cwiseMin(at(length, half_width)); }
  Eigen::Vector2d high() const { return at(0, -half_width).cwiseMax(at(length, half_width)); }

  /// Whether the point lies in it or at most `margin` [m] beside it.
  bool contains(const Eigen::Vector2d& p, double margin) const;
};

/// The streets of the route, each longer than the route needs at both of its ends, and the side streets into
/// which vehicles turn. Vehicles that turn inside one of the route's corners have none.
std::vector<Street> streets_of(const Route& route, const std::vector<Vehicle>& traffic);

/// A stretch of a line of houses, the street on its left from `from` to `to`.
struct HouseLine {
  Eigen::Vector2d from, to;
};

/// Where houses stand: the border of all streets together.
std::vector<HouseLine> house_lines(const std::vector<Street>& streets);

}  // namespace cosight::sim
