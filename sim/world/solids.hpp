#pragma once

#include <vector>

#include "shared/geometry/pose.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// The four sides and the top and bottom of a box, in W and without texture: T_WX puts the middle of its
/// lower face; `size` [m] along x, y, z of X.
std::vector<Quad> box_sides(const Pose& T_WX, const Eigen::Vector3d& size);

/// The `count` sides of an upright prism around z of X, wearing `sheet`'s picture once around.
std::vector<Quad> ring_sides(const Pose& T_WX, double radius, double height, int count, const Quad& sheet);

}  // namespace cosight::sim
