#pragma once

#include <filesystem>
#include <vector>

#include "shared/dataset/frame_encoder.hpp"
#include "shared/dataset/gated_source.hpp"
#include "shared/dataset/laser_mounting.hpp"
#include "shared/dataset/motion_csv.hpp"

namespace cosight {

/// The folder of a two-agent sequence, as the simulator and `cosight prepare` write it:
///
///   robot/calibration.yaml (cam0)  robot/cam0.csv  robot/wearer_pose.csv  robot/known_points.csv
///   robot/lasers.yaml  robot/laser_front.csv  robot/laser_rear.csv  robot/odometry.csv  robot/imu.csv
///   wearer/calibration.yaml (cam0) wearer/cam0.csv wearer/ahrs.csv
///   truth/robot_cam0.tum           truth/wearer_cam0.tum
///
/// Of each agent the first two have to be there; the formats are those of image_list.hpp, motion_csv.hpp and
/// robot_csv.hpp, the stamps of both agents are of one clock.
class CosightDataset {
 public:
  /// Throws DatasetError when there is no such folder.
  explicit CosightDataset(std::filesystem::path folder);

  bool has_wearer() const;
  bool has_wearer_pose() const;
  bool has_imu() const;

  /// Throw ConfigError or DatasetError, each naming the file.
  CameraModel robot_camera() const;
  CameraModel wearer_camera() const;

  /// Frames and, when there are any, poses of the worn camera, laser scans, wheel odometry and IMU. The size
  /// in `output` is set from the calibration.
  std::unique_ptr<SampleSource> open_robot(FrameOutput output = {}, const WearerPoseNoise& noise = {}) const;

  /// Frames, only inside `gate` when that is not empty, and orientations when there are any.
  std::unique_ptr<SampleSource> open_wearer(FrameOutput output = {}, const AhrsNoise& noise = {},
                                            const std::vector<TimeInterval>& gate = {}) const;

  /// None when there is no robot/known_points.csv.
  std::vector<KnownPoint> known_points() const;

  /// Pose of the SLAM camera in the robot's body; nothing when the calibration does not say.
  std::optional<Pose> T_BS() const;
  /// None when there is no robot/lasers.yaml.
  std::vector<LaserMounting> lasers() const;

  std::filesystem::path robot_calibration() const { return folder_ / "robot/calibration.yaml"; }
  std::filesystem::path wearer_calibration() const { return folder_ / "wearer/calibration.yaml"; }
  std::filesystem::path wearer_poses() const { return folder_ / "robot/wearer_pose.csv"; }
  std::filesystem::path robot_truth() const { return folder_ / "truth/robot_cam0.tum"; }
  std::filesystem::path wearer_truth() const { return folder_ / "truth/wearer_cam0.tum"; }

 private:
  std::filesystem::path folder_;
};

}  // namespace cosight
