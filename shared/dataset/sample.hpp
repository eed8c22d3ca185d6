#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstdint>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight {

/// How the bytes of an ImageSample are to be read.
enum class ImageEncoding { kJpeg, kPng, kMono8 };

/// One frame as it travels: still encoded, so that whoever needs the pixels decodes them once.
struct ImageSample {
  Stamp stamp = 0;
  std::uint64_t sequence = 0;  ///< counts the frames of one source; a jump means a lost frame
  ImageEncoding encoding = ImageEncoding::kJpeg;
  int width = 0;   ///< [px]; 0: only the encoded bytes know (a JPEG from elsewhere)
  int height = 0;  ///< [px]
  std::vector<std::uint8_t> bytes;
};

/// What an AHRS on the wearer's head says. `q_WH`: orientation of the wearer's head H (x forward, y left, z
/// up) in the AHRS's own world (z up, x towards its north).
struct AhrsSample {
  Stamp stamp = 0;
  Eigen::Quaterniond q_WH = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d orientation_covariance = Eigen::Matrix3d::Zero();  ///< in the axes of W [rad^2]
  Eigen::Vector3d angular_velocity_H = Eigen::Vector3d::Zero();      ///< [rad/s]
  Eigen::Vector3d acceleration_H = Eigen::Vector3d::Zero();          ///< specific force [m/s^2]
};

/// Where the free camera Cf was seen from the SLAM camera Cs: T_SF at `stamp`, from a tracker or a dataset.
struct WearerPoseSample {
  Stamp stamp = 0;
  UncertainPose T_SF;
  bool has_orientation = true;  ///< false: position only; the orientation then comes from the AHRS
};

/// One turn of a laser range finder (sensor_msgs/LaserScan): ranges [m] from `angle_min` on,
/// counter-clockwise in the x-y plane of the laser L (x the middle of its arc, z up); not finite or outside
/// [range_min, range_max]: nothing came back. All rays are taken to be of `stamp`.
struct LaserScanSample {
  Stamp stamp = 0;
  std::string laser;             ///< which one: "laser_front", "laser_rear"
  float angle_min = 0.0F;        ///< [rad]
  float angle_increment = 0.0F;  ///< [rad]
  float range_min = 0.0F;        ///< [m]
  float range_max = 0.0F;        ///< [m]
  std::vector<float> ranges;
};

/// The robot's inertial sensor, in its own axes I.
struct ImuSample {
  Stamp stamp = 0;
  Eigen::Vector3d angular_velocity_I = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector3d acceleration_I = Eigen::Vector3d::Zero();      ///< specific force [m/s^2]
};

/// What the wheels say of the robot's body B since their start (nav_msgs/Odometry): drifts, never jumps.
struct WheelOdometrySample {
  Stamp stamp = 0;
  double x = 0.0, y = 0.0;  ///< [m] in the frame O of the start
  double yaw = 0.0;         ///< [rad]
  double speed = 0.0;       ///< forward [m/s]
  double turn_rate = 0.0;   ///< [rad/s]
};

using Sample =
    std::variant<ImageSample, AhrsSample, WearerPoseSample, LaserScanSample, ImuSample, WheelOdometrySample>;

Stamp stamp_of(const Sample& sample);

}  // namespace cosight
