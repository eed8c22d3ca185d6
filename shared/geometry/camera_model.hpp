#pragma once

#include <Eigen/Core>
#include <array>
#include <optional>

namespace cosight {

/// How a ray's direction bends in the lens. Names as in Kalibr's yaml, except the last, which is SceneLib's.
enum class Distortion {
  kNone,
  kRadtan,        ///< k1 k2 p1 p2 k3 (Brown-Conrady)
  kEquidistant,   ///< k1 k2 k3 k4 (Kannala-Brandt)
  kScenelibWide,  ///< r_d = r_u / sqrt(1 + 2 k r_u^2), radii in pixels, k [1/px^2]
};

/// A calibrated camera: optical frame x right, y down, z forward [m]; pixels with (0, 0) at the centre of the
/// top left one. Pure functions; nothing here allocates.
struct CameraModel {
  double fx = 500.0, fy = 500.0, cx = 319.5, cy = 239.5;  ///< [px]
  int width = 640, height = 480;                          ///< [px]
  Distortion distortion = Distortion::kNone;
  std::array<double, 5> coefficients{};  ///< meaning by `distortion`; unused ones zero

  /// Pixel of a point in the camera frame, also outside the image. Nothing when the point is not in front of
  /// the camera, or farther off the axis than the distortion polynomial is monotonic. `J` (may be null): d
  /// pixel / d p_C, 2x3.
  std::optional<Eigen::Vector2d> project(const Eigen::Vector3d& p_C,
                                         Eigen::Matrix<double, 2, 3>* J = nullptr) const;

  /// Direction [x/z, y/z, 1] of the ray through a pixel. Nothing when the pixel has no ray (the inverse of
  /// the distortion does not converge). `J` (may be null): d direction / d pixel, 3x2, last row zero.
  std::optional<Eigen::Vector3d> unproject(const Eigen::Vector2d& pixel,
                                           Eigen::Matrix<double, 3, 2>* J = nullptr) const;

  /// Inside the image by at least `margin` pixels.
  bool contains(const Eigen::Vector2d& pixel, double margin = 0.0) const {
    return pixel.x() >= margin && pixel.y() >= margin && pixel.x() <= width - 1 - margin &&
           pixel.y() <= height - 1 - margin;
  }

  double mean_focal_length() const { return 0.5 * (fx + fy); }
};

}  // namespace cosight
