#pragma once

#include <filesystem>
#include <optional>
#include <string>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight {

class ConfigNode;

/// The camera `camera_name` of a calibration file. Understood are
/// - Kalibr's: `cam0: {camera_model: pinhole, distortion_model: radtan | equidistant | none,
///   distortion_coeffs: […], intrinsics: [fx, fy, cx, cy], resolution: [w, h]}`;
/// - the same with `camera_model: pinhole_radtan` or `pinhole_equidistant` and `distortion: […]`;
/// - SceneLib's wide angle: `camera_model: scenelib_wide` with fku, fkv, u0, v0, kd1;
/// - EuRoC's sensor.yaml (no section; `distortion_model: radial-tangential`).
/// A section named `left_and_right` stands for both names. Throws ConfigError with file and line.
CameraModel load_camera_model(const std::filesystem::path& file, const std::string& camera_name = "cam0");

/// Pose of the camera in the body (IMU), from `T_BC`, Kalibr's `T_cam_imu` (its inverse) or EuRoC's `T_BS`;
/// nothing when the file does not say.
std::optional<Pose> load_body_extrinsics(const std::filesystem::path& file,
                                         const std::string& camera_name = "cam0");

/// A rigid transform of 3x4 or 4x4 numbers, written row by row. Throws ConfigError when it is none.
Pose read_transform(const ConfigNode& node, const std::string& key);

/// Kalibr's form, as `load_camera_model` reads it; numbers in full. Throws ConfigError when it can't write.
void write_camera_model(const std::filesystem::path& file, const CameraModel& camera,
                        const std::string& camera_name = "cam0");

}  // namespace cosight
