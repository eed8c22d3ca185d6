#pragma once

#include <atomic>
#include <filesystem>
#include <string>
#include <vector>

#include "shared/config/config.hpp"
#include "shared/dataset/frame_encoder.hpp"
#include "shared/dataset/gated_source.hpp"
#include "shared/dataset/laser_mounting.hpp"
#include "shared/dataset/motion_csv.hpp"

namespace cosight {

/// Of the robot, beside images, video or device; what a dataset folder holds under the same names.
struct RobotFiles {
  std::filesystem::path lasers;  ///< yaml: where the lasers sit and how they measure
  std::filesystem::path laser_front;
  std::filesystem::path laser_rear;
  std::filesystem::path odometry;
  std::filesystem::path imu;
  std::filesystem::path known_points;
};

/// Where an agent's samples come from; the section `input` of its configuration. One of the first six; a
/// dataset beside topics or a recording only says how the robot is built.
struct InputOptions {
  std::filesystem::path dataset;  ///< a Cosight dataset folder, with everything in it
  std::filesystem::path images;   ///< csv, EuRoC or KITTI folder, or plain folder with rate_hz
  std::filesystem::path video;
  std::filesystem::path device;     ///< /dev/video0
  bool topics = false;              ///< robot: what others publish of its sensors
  std::filesystem::path recording;  ///< robot: an MCAP file with all that it and the wearer said
  double end_after = 2.0;           ///< without a publisher of frames the topics have ended [s]; 0: never

  std::filesystem::path calibration;  ///< a dataset and an EuRoC folder have their own
  std::string camera = "cam0";        ///< its section in the calibration
  double rate_hz = 0.0;               ///< of a plain folder, a video or a camera; 0: theirs
  std::filesystem::path ahrs;         ///< wearer: csv beside images, video or device
  std::filesystem::path wearer_pose;  ///< robot: csv beside images, video or device
  RobotFiles robot;
  AhrsNoise ahrs_noise;
  WearerPoseNoise wearer_pose_noise;
  std::vector<TimeInterval> gate;  ///< images only inside; empty: always
  FrameOutput output;
};

enum class Agent { kRobot, kWearer };

/// Knows only the keys that mean something to `agent`. Throws ConfigError, also when none or several of
/// dataset, images, video and device are given.
InputOptions read_input_options(const ConfigNode& node, Agent agent);

/// An input that has been looked at and can be opened, again for every lap of a loop.
struct AgentInput {
  SourceFactory open;  ///< none for topics: those are the transport's
  CameraModel camera;
  bool knows_camera = true;              ///< false: nobody said it yet
  bool live = false;                     ///< a camera or topics: at their own pace, can't be repeated
  std::vector<KnownPoint> known_points;  ///< of a dataset, for the robot
  bool has_wearer_pose = false;          ///< it yields poses of the worn camera, for the robot
  bool has_imu = false;                  ///< it yields the robot's IMU; topics and recordings may not
  std::optional<Pose> T_BS;              ///< of the camera in the robot's body; not known to all
  std::vector<LaserMounting> lasers;     ///< on the robot
};

/// Throws ConfigError or DatasetError with the file's name. `stop` ends a live source; it has to outlive it.
AgentInput prepare_input(const InputOptions& options, Agent agent, const std::atomic<bool>& stop);

}  // namespace cosight
