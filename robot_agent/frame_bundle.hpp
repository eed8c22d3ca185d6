#pragma once

#include <memory>
#include <optional>

#include "shared/dataset/sample.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/uncertain_pose.hpp"
#include "shared/geometry/uncertain_twist.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight {

/// What the wearer gave for one robot frame.
struct WearerView {
  Stamp stamp = 0;                         ///< of the worn camera's image, on the robot's clock
  std::shared_ptr<const GrayImage> image;  ///< never null
  CameraModel camera;                      ///< calibration of Cf
  UncertainPose T_SF;           ///< pose of the free camera in the SLAM camera, covariance included
  bool has_orientation = true;  ///< false: T_SF.T.q is unknown, and `q_WF` stands for it
  /// Orientation of the free camera in W from the AHRS (yaw offset to W already applied), and its covariance
  /// (axes of W). Set when an AHRS sample was near enough in time.
  std::optional<Eigen::Quaterniond> q_WF;
  Eigen::Matrix3d q_WF_covariance = Eigen::Matrix3d::Zero();
};

/// Everything slam needs of one robot frame. Everything asynchronous has ended before this is made.
struct FrameBundle {
  Stamp stamp = 0;                         ///< of the SLAM camera's image
  std::uint64_t sequence = 0;              ///< of the SLAM camera's source
  std::shared_ptr<const GrayImage> image;  ///< null when the frame could not be decoded: predict only
  std::optional<WearerView> wearer;        ///< nothing when no worn frame is near enough in time
  bool wearer_pose_missing = false;  ///< a worn frame was near enough, but no pose of it: `wearer` is nothing
  /// Of the SLAM camera: its mean since the bundle before, measured without this image. Nothing: not known.
  std::optional<UncertainTwist> twist;
  double decode_ms = 0.0;  ///< wall time of decoding both images [ms]
};

}  // namespace cosight
