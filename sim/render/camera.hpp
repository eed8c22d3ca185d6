#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "shared/geometry/camera_model.hpp"

namespace cosight::sim {

/// The lens as the simulator computes it, from the numbers of a CameraModel but with none of its code: an
/// error in one of the two must show in what the filter makes of the pictures.
class Camera {
 public:
  /// Pinhole with none or radtan distortion; others are refused (std::invalid_argument).
  explicit Camera(const CameraModel& calibration);

  const CameraModel& calibration() const { return calibration_; }

  /// Pixel of a point in the optical frame; nothing behind the camera.
  std::optional<Eigen::Vector2d> pixel_of(const Eigen::Vector3d& p_C) const;

  /// (x/z, y/z) of the ray through a pixel.
  Eigen::Vector2d ray_through(const Eigen::Vector2d& pixel) const;

  /// x/z and y/z of the rays through the pixels' centres, rows one after another.
  const std::vector<float>& rays_x() const { return rays_x_; }
  const std::vector<float>& rays_y() const { return rays_y_; }

 private:
  Eigen::Vector2d bend(const Eigen::Vector2d& ideal) const;

  CameraModel calibration_;
  std::vector<float> rays_x_, rays_y_;
};

}  // namespace cosight::sim
