#pragma once

#include <Eigen/Core>
#include <optional>
#include <utility>
#include <vector>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::overlap {

/// What a camera sees between two depths, as a convex body: a cone over a polygon of rays, cut by two planes
/// z = const. The apex may lie behind the camera (a frustum that was grown).
struct Frustum {
  ConvexPolygon rays;    ///< x/z, y/z of the cone's edges as seen from the apex
  double apex_z = 0.0;   ///< where the rays meet on the optical axis [m], <= 0
  double near_z = 0.1;   ///< [m], > apex_z
  double far_z = 100.0;  ///< [m], > near_z
};

/// The rays through the image's corners and the middles of its edges, so that what a lens bends outwards is
/// inside as well; without distortion the four corner rays. Empty when a corner has no ray.
ConvexPolygon image_rays(const CameraModel& camera);

/// n . p <= offset, normal of unit length.
struct HalfSpace {
  Eigen::Vector3d normal = Eigen::Vector3d::Zero();
  double offset = 0.0;
};

/// A convex body by its faces' half-spaces and its edges; empty or with at least four of each.
struct ConvexBody {
  std::vector<HalfSpace> half_spaces;
  std::vector<std::pair<Eigen::Vector3d, Eigen::Vector3d>> edges;
};

/// The frustum of camera C in frame A [m].
ConvexBody to_body(const Frustum& frustum, const Pose& T_AC);

/// All corners of the intersection of two bodies, unordered, possibly repeated; empty when they are disjoint.
/// A corner is the end of an edge of one body clipped by the other.
std::vector<Eigen::Vector3d> intersection_corners(const ConvexBody& a, const ConvexBody& b);

}  // namespace cosight::overlap
