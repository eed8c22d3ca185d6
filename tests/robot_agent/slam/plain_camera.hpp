#pragma once

#include "shared/geometry/camera_model.hpp"

namespace cosight::slam {

/// A camera without distortion, 720 x 480 and 520 px.
inline CameraModel plain_camera() {
  CameraModel model;
  model.width = 720;
  model.height = 480;
  model.fx = model.fy = 520.0;
  model.cx = 359.5;
  model.cy = 239.5;
  return model;
}

}  // namespace cosight::slam
