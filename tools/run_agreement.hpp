#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "shared/evaluation/evaluation.hpp"

namespace cosight {

/// How far a run of the robot agrees with another one of the same data, by the files in their folders:
///
///   frames              that both have
///   equal_poses         of them, those whose pose in trajectory.tum is the same to the last digit
///   first_other_s       when the first pose differs, since the first frame; nothing when none does
///   other_worn_frames   frames that one run paired with another worn frame than the other, or with none
///   distance_rms_m, distance_max_m, angle_max_deg
///                       between the poses, not aligned
///   equal_files         of trajectory.tum, map.ply and map.pcd, those that are equal byte for byte
///
/// Throws EvaluationError when a file can't be read or no frames are common.
std::vector<Metric> agreement(const std::filesystem::path& run, const std::filesystem::path& reference);

/// What the runs' summaries counted differently: what came, what was paired, what was late.
struct CounterRow {
  std::string name;            ///< "inbox.worn_late"
  std::vector<double> counts;  ///< one a run
};
std::vector<CounterRow> differing_counters(const std::vector<std::filesystem::path>& runs);

}  // namespace cosight
