#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <utility>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// The calibration that belongs to an image stream (sensor_msgs/CameraInfo).
struct CameraInfoSample {
  Stamp stamp = 0;
  CameraModel camera;
};

/// Where the SLAM camera S is in the world W and how it moves (nav_msgs/Odometry).
struct OdometrySample {
  Stamp stamp = 0;
  UncertainPose T_WS;
  Eigen::Vector3d v_S = Eigen::Vector3d::Zero();      ///< velocity, in the axes of S [m/s]
  Eigen::Vector3d omega_S = Eigen::Vector3d::Zero();  ///< angular velocity, in the axes of S [rad/s]
  Eigen::Matrix<double, 6, 6> twist_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of [v_S, omega_S]
};

/// A landmark for viewers: position in W [m], brightness, and the standard deviation of its worst axis [m].
struct CloudPoint {
  float x = 0.0F;
  float y = 0.0F;
  float z = 0.0F;
  float intensity = 0.0F;
  float sigma = 0.0F;
};

/// The map as others see it (sensor_msgs/PointCloud2).
struct PointCloudSample {
  Stamp stamp = 0;
  std::vector<CloudPoint> points;
};

/// What the wearer's frame gave for one robot frame (cosight_msgs/OverlapReport). `described` = the sum of
/// the counts after it.
struct OverlapSample {
  Stamp stamp = 0;  ///< of the robot's frame
  bool predicted = false;
  double far_depth = 0.0;                 ///< where the frustums were cut [m]
  std::vector<Eigen::Vector2d> roi_in_S;  ///< [px]
  std::vector<Eigen::Vector2d> roi_in_F;  ///< [px]
  std::uint32_t described = 0;
  std::uint32_t ratio_test = 0;
  std::uint32_t epipolar = 0;
  std::uint32_t too_little_parallax = 0;
  std::uint32_t chi_squared = 0;
  std::uint32_t joint_compatibility = 0;
  std::uint32_t fused = 0;
  std::uint32_t initialised = 0;
  std::uint32_t redundant = 0;
  std::string outcome;
};

enum class DiagnosticLevel : std::uint8_t { kOk = 0, kWarning = 1, kError = 2, kStale = 3 };

/// How a part of an agent is, for monitors (diagnostic_msgs/DiagnosticArray with one status).
struct DiagnosticSample {
  Stamp stamp = 0;
  DiagnosticLevel level = DiagnosticLevel::kOk;
  std::string name;     ///< of the part
  std::string message;  ///< in a few words
  std::vector<std::pair<std::string, std::string>> values;
};

/// "I am here" (cosight_msgs/Heartbeat). A new `instance_id` under a known `agent_id` is a restart when the
/// old one has fallen silent, and a second agent of the same name when it has not.
struct HeartbeatSample {
  Stamp stamp = 0;
  std::string agent_id;
  std::uint64_t instance_id = 0;  ///< drawn anew at every start
  std::uint64_t beat = 0;         ///< counts the heartbeats of this instance
  std::uint64_t frames_sent = 0;
  std::uint64_t orientations_sent = 0;
  SourceCounters frames;
  SourceCounters orientations;
};

}  // namespace cosight
