#pragma once

#include <cmath>
#include <vector>

#include "sim/scenario.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// A texture whose gray is `base + slope * u` [per texel], 200 x 200 texels.
inline GrayImage gradient(double base, double slope) {
  GrayImage image{200, 200, {}};
  for (int y = 0; y < 200; ++y) {
    for (int x = 0; x < 200; ++x)
      image.data.push_back(static_cast<std::uint8_t>(base + slope * (x + 0.5) + 0.5));
  }
  return image;
}

/// A wall across the x axis at `x`, seen from the origin, `size` wide and high, centred on the axis.
inline Quad wall_ahead(double x, double size, const Texture& texture) {
  Quad quad;
  quad.origin = {x, 0.5 * size, 0.5 * size};
  quad.edge_s = {0.0, -size, 0.0};
  quad.edge_t = {0.0, 0.0, -size};
  quad.texture = &texture;
  quad.u1 = static_cast<float>(texture.width());
  quad.v1 = static_cast<float>(texture.height());
  return quad;
}

/// In the origin of W, looking along x.
inline Pose looking_ahead() {
  return optical_mount(Eigen::Vector3d::Zero(), 0.0, 0.0);
}

}  // namespace cosight::sim
