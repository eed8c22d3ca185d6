#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shared/dataset/stamp.hpp"
#include "shared/geometry/camera_model.hpp"

namespace cosight::inbox {

constexpr Stamp from_milliseconds(std::int64_t milliseconds) {
  return milliseconds * 1'000'000;
}

/// Which worn frame belongs to a robot frame, and how long to wait for one.
struct PairingOptions {
  /// Between the stamps of a pair. Half a frame interval of the slower camera, and some jitter.
  Stamp max_pair_interval = from_milliseconds(40);
  /// From a robot frame's arrival until it is handed on without what is still missing. Adds latency only
  /// while the wearer is there; raise it on a slow link.
  Stamp max_wait = from_milliseconds(150);
  /// A wearer (or an AHRS) unheard for this long is not waited for.
  Stamp wearer_silence = from_milliseconds(500);
  /// Poses may come seldom: they are waited for until unheard for this long.
  Stamp pose_silence = from_milliseconds(5000);
  std::size_t max_queued_images = 60;         ///< of each camera, still encoded
  std::size_t max_queued_bytes = 64'000'000;  ///< of each camera
  std::size_t max_queued_frames = 1'000'000;  ///< robot frames whose image was already given up (100 B each)
};

/// How far the wearer's pose and orientation may be carried from the samples to the stamp of a worn frame,
/// and what that adds to their covariance.
struct InterpolationOptions {
  Stamp max_interval = from_milliseconds(60);  ///< to the nearest sample
  double acceleration = 2.0;                   ///< [m/s^2] 1 sigma, bends the way between two samples
  double angular_acceleration = 3.0;           ///< [rad/s^2] 1 sigma
  double speed = 1.0;                          ///< [m/s] 1 sigma, beyond the first or last sample
  double turn_rate = 1.0;                      ///< [rad/s] 1 sigma
};

/// From what the AHRS says to the orientation of the free camera in W:
///
///   q_WF = R_z(yaw_offset) q_WH q_HF
struct MountingOptions {
  /// Optical frame (x right, y down, z forward) on the head (x forward, y left, z up), level and looking
  /// ahead.
  Eigen::Quaterniond q_HF = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);
  double mounting_sigma = 0.005;  ///< of q_HF, each axis [rad]
  double yaw_offset = 0.0;        ///< from the AHRS's north to W's x axis [rad]; slam finds out what it lacks
};

/// What an image must measure; 0: anything.
struct ImageSize {
  int width = 0;
  int height = 0;
};

struct InboxOptions {
  PairingOptions pairing;
  InterpolationOptions interpolation;
  MountingOptions mounting;
  ImageSize robot_size;                 ///< [px] of the SLAM camera's calibration
  std::optional<CameraModel> camera_F;  ///< calibration of the free camera, when it is not sent
};

/// For frames of that camera.
inline InboxOptions with_camera(InboxOptions options, const CameraModel& camera) {
  options.robot_size = {camera.width, camera.height};
  return options;
}

}  // namespace cosight::inbox
