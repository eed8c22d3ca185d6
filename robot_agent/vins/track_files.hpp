#pragma once

#include <filesystem>
#include <stdexcept>
#include <vector>

#include "robot_agent/vins/imu.hpp"
#include "robot_agent/vins/window.hpp"
#include "shared/evaluation/trajectory.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::vins {

/// A recorded feature-level sequence cannot be read; says which file and where.
class TrackFileError : public std::runtime_error {
  using std::runtime_error::runtime_error;
};

/// A drive as feature tracks and IMU samples with its truth, as `urban_tracks` has them.
struct TrackSequence {
  std::vector<FeatureFrame> frames;
  std::vector<ImuSample> imu;
  Trajectory truth;  ///< T_WB, one for each frame
  Pose T_BS;
  double time_offset = 0.0;  ///< [s]
  double gravity = 9.81;     ///< [m/s^2]
};

/// Reads cam.txt, imu.txt, tracks.txt and gt_tum.txt of a folder. Throws TrackFileError, and EvaluationError
/// for the truth.
TrackSequence read_track_sequence(const std::filesystem::path& folder);

}  // namespace cosight::vins
