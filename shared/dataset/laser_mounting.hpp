#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shared/geometry/pose.hpp"

namespace cosight {

/// A laser range finder on the robot: where it sits and how it measures.
struct LaserMounting {
  std::string laser;             ///< as its samples call it: "laser_front"
  Pose T_BL;                     ///< the laser (x the middle of its arc, z up) in the robot's body
  int points = 0;                ///< of one turn
  double angle_min = 0.0;        ///< of the first ray, the rightmost one [rad]
  double angle_increment = 0.0;  ///< [rad]
  double range_min = 0.0;        ///< [m]
  double range_max = 0.0;        ///< [m]
  double range_sigma = 0.015;    ///< of one range [m]
};

/// The sections `front`, `rear` … of a lasers.yaml: `points`, `angle_min_rad`, `angle_increment_rad`,
/// `range_min_m`, `range_max_m`, `range_sigma_m`, `T_BL` (3x4 or 4x4). The section `front` is of the laser
/// `laser_front`. Throws ConfigError with file and line.
std::vector<LaserMounting> read_laser_mountings(const std::filesystem::path& yaml);

}  // namespace cosight
