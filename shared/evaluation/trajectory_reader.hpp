#pragma once

#include <filesystem>

#include "shared/evaluation/trajectory.hpp"

namespace cosight {

/// Reads a trajectory whose format is told by its first row of numbers:
///
///   TUM     t[s] px py pz qx qy qz qw                      blanks
///   EuRoC   t[ns], px, py, pz, qw, qx, qy, qz [, …]        commas
///   KITTI   the 3x4 matrix [R|p], row by row               12 numbers; stamps from `kitti_times` [s a line],
///                                                          or one second a row without such a file
///
/// Lines that start with # are comments. Throws EvaluationError with "file:line: …" for anything that is not
/// a finite number, a quaternion whose length is not 1 within 1 %, a matrix that is no rotation, or a stamp
/// that does not increase; and for an empty file.
Trajectory read_trajectory(const std::filesystem::path& path, const std::filesystem::path& kitti_times = {});

}  // namespace cosight
