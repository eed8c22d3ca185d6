#pragma once

#include <vector>

#include "robot_agent/wearer/planar_scan.hpp"

namespace cosight::wearer {

/// Groups of points, each nearer than `gap` [m] to another one of its group; by ascending ray inside a group,
/// groups by their first ray.
std::vector<std::vector<ScanPoint>> clusters(const std::vector<ScanPoint>& points, double gap);

}  // namespace cosight::wearer
