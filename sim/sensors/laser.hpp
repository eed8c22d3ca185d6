#pragma once

#include <cstdint>
#include <functional>
#include <numbers>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "sim/sensors/inertial.hpp"
#include "sim/sensors/sensor_clock.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// A laser range finder that turns in a plane; Leuze RS4-4 by default.
struct LaserPlan {
  TimingPlan timing{.rate = 25.0};
  Pose T_BL{};                                    ///< x the middle of the arc, z up; rays in its x-y plane
  int points = 133;                               ///< evenly over the arc, both ends included
  double arc = 190.0 * std::numbers::pi / 180.0;  ///< [rad]
  double range_min = 0.3, range_max = 20.0;       ///< [m]
  double sigma = 0.015;                           ///< per range [m]
  double bias = 0.0;                              ///< of all ranges [m]
  double miss = 0.002;                            ///< share of rays that bring nothing back

  double angle_of(int point) const { return arc * (static_cast<double>(point) / (points - 1) - 0.5); }
};

/// One turn: ranges [m] from the right end of the arc to the left; infinite where nothing came back.
struct LaserScan {
  Stamp stamp = 0;
  std::vector<float> ranges;
};

/// What is in the way of the laser at a time since the start [s].
using Surroundings = std::function<std::vector<Quad>(double time)>;

/// The exact distances along the rays, 0 where there is nothing.
std::vector<double> exact_ranges(const LaserPlan& plan, const Pose& T_WB, std::span<const Quad> quads);

std::vector<LaserScan> simulate_laser(const LaserPlan& plan, const Motion& T_WB, const Surroundings& quads_at,
                                      double duration, std::uint64_t seed);

}  // namespace cosight::sim
