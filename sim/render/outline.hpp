#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>

#include "shared/geometry/pose.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// A rectangle of rays (x/z, y/z).
struct RayBox {
  Eigen::Vector2f low = Eigen::Vector2f::Zero();
  Eigen::Vector2f high = Eigen::Vector2f::Zero();
};

/// A quad as a convex polygon of rays (x/z, y/z), cut at a near plane: tells which parts of a picture cannot
/// show it.
class Outline {
 public:
  /// Empty when the quad is behind the camera or shows its back.
  Outline(const Quad& quad, const Pose& T_CW);

  bool empty() const { return count_ < 3; }

  /// False only when no ray of the box meets the quad.
  bool may_overlap(const RayBox& box) const;

 private:
  void add(const Eigen::Vector2f& corner);

  std::array<Eigen::Vector2f, 6> corners_;
  std::size_t count_ = 0;
  RayBox bounds_;
};

}  // namespace cosight::sim
