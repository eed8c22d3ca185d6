#pragma once

#include <cmath>
#include <limits>

#include "shared/dataset/sample.hpp"

namespace cosight::robot {

/// A turn of the front laser in an empty world with one person ahead of it: two legs side by side.
inline LaserScanSample scan_of_person(Stamp stamp, double distance = 1.5) {
  constexpr int kPoints = 361;
  constexpr double kRadius = 0.08;
  LaserScanSample scan{.stamp = stamp,
                       .laser = "laser_front",
                       .angle_min = -1.5F,
                       .angle_increment = 3.0F / (kPoints - 1),
                       .range_min = 0.3F,
                       .range_max = 20.0F,
                       .ranges = {}};
  for (int i = 0; i < kPoints; ++i) {
    const double angle = -1.5 + 3.0 * i / (kPoints - 1);
    double range = std::numeric_limits<double>::infinity();
    for (const double left : {-0.18, 0.18}) {  // along the ray: closest approach, then back to the surface
      const double along = distance * std::cos(angle) + left * std::sin(angle);
      const double aside = distance * std::sin(angle) - left * std::cos(angle);
      if (along <= 0.0 || std::abs(aside) >= kRadius) continue;
      range = std::min(range, along - std::sqrt(kRadius * kRadius - aside * aside));
    }
    scan.ranges.push_back(static_cast<float>(range));
  }
  return scan;
}

}  // namespace cosight::robot
