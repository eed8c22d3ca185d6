#pragma once

#include <filesystem>
#include <ostream>
#include <string>

#include "shared/evaluation/trajectory.hpp"

namespace cosight {

enum class TrajectoryFormat { kTum, kEuroc, kKitti };

/// Writes what read_trajectory reads, positions and quaternions to 1e-9. `comment` becomes the first line
/// (TUM only): which frame in which.
void write_trajectory(std::ostream& out, const Trajectory& trajectory, TrajectoryFormat format,
                      const std::string& comment = "t px py pz qx qy qz qw");

/// The same to a file; throws EvaluationError when it can't be written completely.
void write_trajectory(const std::filesystem::path& path, const Trajectory& trajectory,
                      TrajectoryFormat format, const std::string& comment = "t px py pz qx qy qz qw");

}  // namespace cosight
