#include "sim/world/solids.hpp"

#include <cmath>
#include <numbers>

namespace cosight::sim {
namespace {

Quad face(const Pose& T_WX, const Eigen::Vector3d& origin, const Eigen::Vector3d& edge_s,
          const Eigen::Vector3d& edge_t) {
  Quad quad;
  quad.origin = T_WX * origin;
  quad.edge_s = T_WX.q * edge_s;
  quad.edge_t = T_WX.q * edge_t;
  return quad;
}

}  // namespace

std::vector<Quad> box_sides(const Pose& T_WX, const Eigen::Vector3d& size) {
  const double x = 0.5 * size.x();
  const double y = 0.5 * size.y();
  const double z = size.z();
  const Eigen::Vector3d down{0, 0, -z};
  return {
      face(T_WX, {x, -y, z}, {0, 2 * y, 0}, down),            // seen from +x
      face(T_WX, {-x, y, z}, {0, -2 * y, 0}, down),           // from -x
      face(T_WX, {x, y, z}, {-2 * x, 0, 0}, down),            // from +y
      face(T_WX, {-x, -y, z}, {2 * x, 0, 0}, down),           // from -y
      face(T_WX, {-x, y, z}, {2 * x, 0, 0}, {0, -2 * y, 0}),  // from above
      face(T_WX, {-x, -y, 0}, {2 * x, 0, 0}, {0, 2 * y, 0}),  // from below
  };
}

std::vector<Quad> ring_sides(const Pose& T_WX, double radius, double height, int count, const Quad& sheet) {
  std::vector<Quad> sides;
  const auto corner = [&](int k) {
    const double angle = 2.0 * std::numbers::pi * k / count;
    return Eigen::Vector3d(radius * std::cos(angle), radius * std::sin(angle), height);
  };
  for (int k = 0; k < count; ++k) {
    // Counter-clockwise around the column is to the right for whoever looks at it.
    Quad side = face(T_WX, corner(k), corner(k + 1) - corner(k), {0, 0, -height});
    side.texture = sheet.texture;
    const float width = (sheet.u1 - sheet.u0) / static_cast<float>(count);
    side.u0 = sheet.u0 + static_cast<float>(k) * width;
    side.u1 = side.u0 + width;
    side.v0 = sheet.v0;
    side.v1 = sheet.v1;
    side.shade = sheet.shade;
    sides.push_back(side);
  }
  return sides;
}

}  // namespace cosight::sim
