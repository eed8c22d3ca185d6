#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "sim/world/texture.hpp"

namespace cosight::sim {

/// A flat parallelogram in the world W [m]: the only shape there is (a pillar is a ring of them). It is seen
/// from the side from which s runs to the right and t down, and not at all from behind.
struct Quad {
  Eigen::Vector3d origin = Eigen::Vector3d::Zero();  ///< corner s = t = 0
  Eigen::Vector3d edge_s = Eigen::Vector3d::UnitX();
  Eigen::Vector3d edge_t = Eigen::Vector3d::UnitY();
  const Texture* texture = nullptr;
  float u0 = 0.0F, v0 = 0.0F, u1 = 1.0F, v1 = 1.0F;  ///< part of the texture at s, t = 0 … 1 [texels]
  float shade = 1.0F;                                ///< factor on the texture's brightness
  float reflectivity = 0.0F;                         ///< 0: matt; 1: a mirror

  /// Away from the side it is seen from; not of unit length.
  Eigen::Vector3d inward_normal() const { return edge_s.cross(edge_t); }
};

/// Where a ray meets the scene.
struct Hit {
  double range = 0.0;  ///< in lengths of the ray's direction
  double s = 0.0, t = 0.0;
  std::size_t quad = 0;
};

/// The nearest quad that faces the ray `origin + range * direction` (W), range > 0; nothing when it leaves
/// the world.
std::optional<Hit> cast_ray(std::span<const Quad> quads, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction);

/// All that stands still. Textures are shared by pointer, so that figures can point to theirs as well.
struct Scene {
  std::vector<std::unique_ptr<Texture>> textures;
  std::vector<Quad> quads;

  const Texture* add_texture(GrayImage picture);
};

}  // namespace cosight::sim
