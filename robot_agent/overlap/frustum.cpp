#include "robot_agent/overlap/frustum.hpp"

#include <Eigen/Geometry>
#include <algorithm>
#include <cstddef>

namespace cosight::overlap {
namespace {

using Edge = std::pair<Eigen::Vector3d, Eigen::Vector3d>;

/// Appends the ends of the part of `edge` inside `body`. Touching counts as inside: of two equal bodies every
/// edge lies in the other's faces.
void append_clipped(const Edge& edge, const ConvexBody& body, std::vector<Eigen::Vector3d>& corners) {
  const Eigen::Vector3d along = edge.second - edge.first;
  const double tolerance = 1e-9 * (1.0 + edge.first.norm() + along.norm());
  double begin = 0.0;
  double end = 1.0;
  for (const HalfSpace& space : body.half_spaces) {
    const double excess = space.normal.dot(edge.first) - space.offset - tolerance;
    const double slope = space.normal.dot(along);
    if (slope == 0.0) {
      if (excess > 0.0) return;
      continue;
    }
    const double crossing = -excess / slope;
    if (slope > 0.0) {
      end = std::min(end, crossing);
    } else {
      begin = std::max(begin, crossing);
    }
    if (begin > end) return;
  }
  corners.emplace_back(edge.first + begin * along);
  corners.emplace_back(edge.first + end * along);
}

}  // namespace

ConvexPolygon image_rays(const CameraModel& camera) {
  // The image reaches half a pixel beyond its outermost pixel centres.
  const double left = -0.5;
  const double top = -0.5;
  const double right = camera.width - 0.5;
  const double bottom = camera.height - 0.5;
  const double middle_x = 0.5 * (left + right);
  const double middle_y = 0.5 * (top + bottom);
  const Eigen::Vector2d corners[4] = {{left, top}, {right, top}, {right, bottom}, {left, bottom}};
  const Eigen::Vector2d middles[4] = {
      {middle_x, top}, {right, middle_y}, {middle_x, bottom}, {left, middle_y}};
  std::vector<Eigen::Vector2d> rays;
  for (const Eigen::Vector2d& corner : corners) {
    const auto ray = camera.unproject(corner);
    if (!ray) return {};
    rays.emplace_back(ray->head<2>());
  }
  if (camera.distortion != Distortion::kNone) {
    for (const Eigen::Vector2d& middle : middles) {
      if (const auto ray = camera.unproject(middle)) rays.emplace_back(ray->head<2>());
    }
  }
  return convex_hull(std::move(rays));
}

ConvexBody to_body(const Frustum& frustum, const Pose& T_AC) {
  ConvexBody body;
  const std::size_t n = frustum.rays.size();
  if (n < 3 || !(frustum.far_z > frustum.near_z)) return body;
  const Eigen::Matrix3d R_AC = T_AC.q.toRotationMatrix();
  const Eigen::Vector3d apex_C(0.0, 0.0, frustum.apex_z);
  const auto corner = [&](std::size_t i, double z) -> Eigen::Vector3d {
    return R_AC * (apex_C + (z - frustum.apex_z) * frustum.rays[i % n].homogeneous()) + T_AC.p;
  };
  const Eigen::Vector3d axis_A = R_AC.col(2);
  const double origin = axis_A.dot(T_AC.p);
  body.half_spaces.push_back({-axis_A, -(origin + frustum.near_z)});
  body.half_spaces.push_back({axis_A, origin + frustum.far_z});
  for (std::size_t i = 0; i < n; ++i) {
    const Eigen::Vector3d ray = frustum.rays[i].homogeneous();
    const Eigen::Vector3d next = frustum.rays[(i + 1) % n].homogeneous();
    const Eigen::Vector3d normal = R_AC * next.cross(ray).normalized();
    body.half_spaces.push_back({normal, normal.dot(R_AC * apex_C + T_AC.p)});
    body.edges.emplace_back(corner(i, frustum.near_z), corner(i, frustum.far_z));
    body.edges.emplace_back(corner(i, frustum.near_z), corner(i + 1, frustum.near_z));
    body.edges.emplace_back(corner(i, frustum.far_z), corner(i + 1, frustum.far_z));
  }
  return body;
}

std::vector<Eigen::Vector3d> intersection_corners(const ConvexBody& a, const ConvexBody& b) {
  std::vector<Eigen::Vector3d> corners;
  if (a.edges.empty() || b.edges.empty()) return corners;
  for (const Edge& edge : a.edges)
    append_clipped(edge, b, corners);
  for (const Edge& edge : b.edges)
    append_clipped(edge, a, corners);
  return corners;
}

}  // namespace cosight::overlap
