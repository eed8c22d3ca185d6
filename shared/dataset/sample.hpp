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

using Sample = std::variant<ImageSample, AhrsSample, WearerPoseSample>;

Stamp stamp_of(const Sample& sample);

}  // namespace cosight
