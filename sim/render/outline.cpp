#include "sim/render/outline.hpp"

#include <algorithm>

namespace cosight::sim {
namespace {

constexpr double kNear = 0.02;  // [m]

bool any_corner_inside(const RayBox& box, const Eigen::Vector2f& on_edge, const Eigen::Vector2f& inward) {
  // The box's corner farthest along the edge's inward normal decides.
  const Eigen::Vector2f farthest{inward.x() > 0 ? box.high.x() : box.low.x(),
                                 inward.y() > 0 ? box.high.y() : box.low.y()};
  return inward.dot(farthest - on_edge) >= 0.0F;
}

}  // namespace

Outline::Outline(const Quad& quad, const Pose& T_CW) {
  const Eigen::Vector3d origin_C = T_CW * quad.origin;
  const Eigen::Vector3d s_C = T_CW.q * quad.edge_s;
  const Eigen::Vector3d t_C = T_CW.q * quad.edge_t;
  if (s_C.cross(t_C).dot(origin_C) <= 0.0) return;
  // Runs clockwise in the picture (x right, y down), the way the quad is seen.
  const std::array<Eigen::Vector3d, 4> corners_C{origin_C, origin_C + s_C, origin_C + s_C + t_C,
                                                 origin_C + t_C};
  for (std::size_t k = 0; k < corners_C.size(); ++k) {
    const Eigen::Vector3d& a = corners_C[k];
    const Eigen::Vector3d& b = corners_C[(k + 1) % corners_C.size()];
    if (a.z() >= kNear) add((a.head<2>() / a.z()).cast<float>());
    if ((a.z() >= kNear) != (b.z() >= kNear)) {
      const Eigen::Vector3d cut = a + (kNear - a.z()) / (b.z() - a.z()) * (b - a);
      add((cut.head<2>() / kNear).cast<float>());
    }
  }
}

void Outline::add(const Eigen::Vector2f& corner) {
  bounds_.low = count_ == 0 ? corner : Eigen::Vector2f(bounds_.low.cwiseMin(corner));
  bounds_.high = count_ == 0 ? corner : Eigen::Vector2f(bounds_.high.cwiseMax(corner));
  corners_[count_++] = corner;
}

bool Outline::may_overlap(const RayBox& box) const {
  if (empty() || (box.low.array() > bounds_.high.array()).any() ||
      (box.high.array() < bounds_.low.array()).any()) {
    return false;
  }
  for (std::size_t k = 0; k < count_; ++k) {
    const Eigen::Vector2f edge = corners_[(k + 1) % count_] - corners_[k];
    if (!any_corner_inside(box, corners_[k], {-edge.y(), edge.x()})) return false;
  }
  return true;
}

}  // namespace cosight::sim
