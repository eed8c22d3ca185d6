#pragma once

#include <Eigen/Core>
#include <functional>
#include <random>
#include <vector>

#include "sim/city/route.hpp"

namespace cosight::sim {

constexpr double kGroundBelowCar = -0.9;  ///< z of the road where the car's body is at 0 [m]

/// A vehicle V: a box on the road with texture on its faces. V: x forward, y left, z up, origin on the
/// ground.
struct Vehicle {
  struct Point {
    Eigen::Vector3d p_V, normal_V;
  };

  double from = 0.0, to = 0.0;       ///< there from, to [s]
  std::function<Pose(double)> T_WV;  ///< at a time in between
  Eigen::Vector3d size;              ///< [m]
  std::vector<Point> points;

  /// Whether the box stands between two points of V.
  bool hides(const Eigen::Vector3d& eye_V, const Eigen::Vector3d& p_V) const;
};

/// How many vehicles there are.
struct TrafficOptions {
  double ahead_share = 0.5;            ///< of the time that somebody drives ahead in the same lane
  double neighbours_per_minute = 1.0;  ///< overtake, or are overtaken
  double oncoming_per_minute = 4.0;
  double turning_per_minute = 1.0;  ///< oncoming ones that turn into a side street
  double crossing_per_corner = 1.0;
  double texture = 1.0;     ///< points on a vehicle, times the usual
  bool continuous = false;  ///< nobody appears or vanishes in view: what a picture would show
};

/// All vehicles that the car meets on its route, which must outlive them.
std::vector<Vehicle> make_traffic(const Route& route, const TrafficOptions& options, std::mt19937_64& random);

}  // namespace cosight::sim
