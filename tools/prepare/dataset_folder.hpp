#pragma once

#include <cstdint>
#include <filesystem>

#include "tools/prepare/pose_noise.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {

struct DatasetNoise {
  PoseNoise wearer_pose;
  /// Of the wearer's AHRS about the axes of its world: roll and pitch, roll and pitch, yaw [rad].
  Eigen::Vector3d ahrs_sigma = Eigen::Vector3d(0.5, 0.5, 1.0) * 0.017453292519943295;
  std::uint64_t seed = 1;
};

/// Writes a Cosight dataset folder:
///
///   robot/calibration.yaml   robot/cam0.csv   robot/wearer_pose.csv   robot/known_points.csv
///   wearer/calibration.yaml  wearer/cam0.csv  wearer/ahrs.csv
///   truth/robot_cam0.tum     truth/wearer_cam0.tum
///
/// leaving out what the sequence does not have. Images stay where they are. Throws PrepareError when a file
/// can't be written.
void write_dataset_folder(const std::filesystem::path& folder, const RealSequence& sequence,
                          const DatasetNoise& noise);

}  // namespace cosight
