#include "sim/world/scene.hpp"

#include <utility>

namespace cosight::sim {

std::optional<Hit> cast_ray(std::span<const Quad> quads, const Eigen::Vector3d& origin,
                            const Eigen::Vector3d& direction) {
  std::optional<Hit> nearest;
  for (std::size_t k = 0; k < quads.size(); ++k) {
    const Quad& quad = quads[k];
    const Eigen::Vector3d n = quad.inward_normal();
    const double approach = n.dot(direction);
    if (approach <= 0.0) continue;
    const double range = n.dot(quad.origin - origin) / approach;
    if (range <= 1e-9 || (nearest && range >= nearest->range)) continue;
    const Eigen::Vector3d offset = origin + range * direction - quad.origin;
    const double s = offset.cross(quad.edge_t).dot(n) / n.squaredNorm();
    const double t = quad.edge_s.cross(offset).dot(n) / n.squaredNorm();
    if (s < 0.0 || s > 1.0 || t < 0.0 || t > 1.0) continue;
    nearest = Hit{range, s, t, k};
  }
  return nearest;
}

const Texture* Scene::add_texture(GrayImage picture) {
  textures.push_back(std::make_unique<Texture>(std::move(picture)));
  return textures.back().get();
}

}  // namespace cosight::sim
