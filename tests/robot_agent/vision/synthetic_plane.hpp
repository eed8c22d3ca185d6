#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "robot_agent/vision/patch_warp.hpp"
#include "shared/image/gray_image.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {

inline CameraModel slam_camera() {
  CameraModel camera{458.0, 457.0, 187.0, 128.0, 376, 256, Distortion::kRadtan, {}};
  camera.coefficients = {-0.28, 0.07, 0.0002, 0.00002, 0.0};
  return camera;
}

inline CameraModel worn_camera() {
  return {320.0, 322.0, 190.0, 120.0, 380, 240, Distortion::kNone, {}};
}

/// A textured plane through `p_W` with normal `n_W`; 200 texture units a metre.
struct TexturedPlane {
  Eigen::Vector3d p_W;
  Eigen::Vector3d n_W;
  SyntheticTexture texture;

  GrayImage seen_from(const View& view) const {
    const Eigen::Vector3d along = n_W.unitOrthogonal();
    const Eigen::Vector3d across = n_W.cross(along);
    return texture.render(view.camera.width, view.camera.height, [&](const Eigen::Vector2d& pixel) {
      const Eigen::Vector3d ray_W = view.T_WC.q * *view.camera.unproject(pixel);
      const double depth = n_W.dot(p_W - view.T_WC.p) / n_W.dot(ray_W);
      const Eigen::Vector3d offset = view.T_WC.p + depth * ray_W - p_W;
      return Eigen::Vector2d(200.0 * along.dot(offset), 200.0 * across.dot(offset));
    });
  }
};

}  // namespace cosight::vision
