#include "robot_agent/overlap/predict_overlap.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>

#include "robot_agent/overlap/frustum.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::overlap {
namespace {

using Matrix23 = Eigen::Matrix<double, 2, 3>;

/// d (x/z, y/z) / d p.
Matrix23 normalised_jacobian(const Eigen::Vector3d& p) {
  Matrix23 J;
  J << 1.0, 0.0, -p.x() / p.z(), 0.0, 1.0, -p.y() / p.z();
  return J / p.z();
}

/// Appends the corners of the box of half sides `reach` around `centre`.
void append_box(const Eigen::Vector2d& centre, const Eigen::Vector2d& reach,
                std::vector<Eigen::Vector2d>& points) {
  for (const double x : {-1.0, 1.0}) {
    for (const double y : {-1.0, 1.0})
      points.emplace_back(centre + Eigen::Vector2d(x, y).cwiseProduct(reach));
  }
}

/// n sigmas of a normalised coordinate; beyond a right angle the linearisation means nothing.
Eigen::Vector2d bounded_reach(const Eigen::Matrix2d& covariance, double n_sigmas) {
  constexpr double kMaxReach = 10.0;
  return (n_sigmas * covariance.diagonal().cwiseMax(0.0).cwiseSqrt()).cwiseMin(kMaxReach);
}

/// A frustum that holds every frustum whose pose is within n sigmas: rays turned outwards by the rotation's
/// error, the apex drawn back until the sides have moved out by the position's error.
Frustum grown(const Frustum& frustum, const UncertainPose& T_SF, double n_sigmas) {
  const Eigen::Matrix3d R_FS = T_SF.T.q.toRotationMatrix().transpose();
  const Eigen::Matrix3d rotation_F = R_FS * T_SF.covariance.bottomRightCorner<3, 3>() * R_FS.transpose();
  std::vector<Eigen::Vector2d> rays;
  double least_sine = 1.0;
  for (const Eigen::Vector2d& ray : frustum.rays) {
    const Eigen::Vector3d d = ray.homogeneous();
    const Matrix23 J = normalised_jacobian(d) * skew(d);
    append_box(ray, bounded_reach(J * rotation_F * J.transpose(), n_sigmas), rays);
  }
  Frustum result = frustum;
  result.rays = convex_hull(std::move(rays));
  for (std::size_t i = 0; i < result.rays.size(); ++i) {
    const Eigen::Vector3d ray = result.rays[i].homogeneous();
    const Eigen::Vector3d next = result.rays[(i + 1) % result.rays.size()].homogeneous();
    // The face's angle to the axis: its unit normal's component along z.
    least_sine = std::min(least_sine, std::abs(ray.cross(next).normalized().z()));
  }
  const double position = n_sigmas * std::sqrt(std::max(0.0, T_SF.covariance.topLeftCorner<3, 3>().trace()));
  constexpr double kNarrowest = 0.02;
  result.apex_z = -position / std::max(least_sine, kNarrowest);
  // Points must stay in front of the camera to be projected.
  result.near_z = std::max(frustum.near_z - position, 0.25 * frustum.near_z);
  result.far_z = frustum.far_z + position;
  return result;
}

/// A polygon of normalised coordinates as one of pixels inside the image. Straight edges become curves in the
/// lens, so points along them are taken as well.
ConvexPolygon to_pixels(const ConvexPolygon& normalised, const CameraModel& camera,
                        const ConvexPolygon& rays) {
  const Rectangle seen = bounding_box(rays);
  const ConvexPolygon inside = clip(normalised, seen);
  const int pieces = camera.distortion == Distortion::kNone ? 1 : 8;
  std::vector<Eigen::Vector2d> pixels;
  for (std::size_t i = 0; i < inside.size(); ++i) {
    const Eigen::Vector2d& begin = inside[i];
    const Eigen::Vector2d& end = inside[(i + 1) % inside.size()];
    for (int k = 0; k < pieces; ++k) {
      const Eigen::Vector2d point = begin + static_cast<double>(k) / pieces * (end - begin);
      if (const auto pixel = camera.project(point.homogeneous())) pixels.push_back(*pixel);
    }
  }
  const Rectangle image{{0.0, 0.0}, {camera.width - 1.0, camera.height - 1.0}};
  return clip(convex_hull(std::move(pixels)), image);
}

std::vector<Eigen::Vector2d> normalised_in_S(const std::vector<Eigen::Vector3d>& corners_S) {
  std::vector<Eigen::Vector2d> points;
  points.reserve(corners_S.size());
  for (const Eigen::Vector3d& p_S : corners_S)
    points.emplace_back(p_S.hnormalized());
  return points;
}

/// Each corner as a box of n sigmas: p_F = R^T Exp(-dtheta) (p_S - p - dp), see UncertainPose.
std::vector<Eigen::Vector2d> normalised_in_F(const std::vector<Eigen::Vector3d>& corners_S,
                                             const UncertainPose& T_SF, double n_sigmas) {
  const Eigen::Matrix3d R_FS = T_SF.T.q.toRotationMatrix().transpose();
  std::vector<Eigen::Vector2d> points;
  points.reserve(4 * corners_S.size());
  for (const Eigen::Vector3d& p_S : corners_S) {
    const Eigen::Vector3d from_F = p_S - T_SF.T.p;
    const Eigen::Vector3d p_F = R_FS * from_F;
    if (!(p_F.z() > 0.0)) continue;
    Eigen::Matrix<double, 2, 6> J;
    J.leftCols<3>() = -normalised_jacobian(p_F) * R_FS;
    J.rightCols<3>() = normalised_jacobian(p_F) * R_FS * skew(from_F);
    append_box(p_F.hnormalized(), bounded_reach(J * T_SF.covariance * J.transpose(), n_sigmas), points);
  }
  return points;
}

}  // namespace

double far_depth(double baseline, const OverlapOptions& options) {
  const double min_parallax = options.min_parallax_deg * std::numbers::pi / 180.0;
  return std::clamp(baseline / (2.0 * std::tan(0.5 * min_parallax)), options.near, options.far);
}

OverlapEstimate predict_overlap(const CameraModel& camera_S, const CameraModel& camera_F,
                                const UncertainPose& T_SF, const OverlapOptions& options) {
  OverlapEstimate estimate;
  estimate.far_depth = far_depth(T_SF.T.p.norm(), options);
  const Frustum frustum_S{image_rays(camera_S), 0.0, options.near, estimate.far_depth};
  const Frustum frustum_F{image_rays(camera_F), 0.0, options.near, estimate.far_depth};
  if (frustum_S.rays.empty() || frustum_F.rays.empty()) return estimate;
  const ConvexBody body_S = to_body(frustum_S, Pose{});
  const ConvexBody body_F = to_body(grown(frustum_F, T_SF, options.n_sigmas), T_SF.T);
  const std::vector<Eigen::Vector3d> corners_S = intersection_corners(body_S, body_F);
  if (corners_S.empty()) return estimate;

  ConvexPolygon roi_in_S = to_pixels(convex_hull(normalised_in_S(corners_S)), camera_S, frustum_S.rays);
  ConvexPolygon roi_in_F =
      to_pixels(convex_hull(normalised_in_F(corners_S, T_SF, options.n_sigmas)), camera_F, frustum_F.rays);
  if (covered_fraction(roi_in_S, camera_S) < options.min_area_fraction ||
      covered_fraction(roi_in_F, camera_F) < options.min_area_fraction) {
    return estimate;
  }
  estimate.predicted = true;
  estimate.roi_in_S = std::move(roi_in_S);
  estimate.roi_in_F = std::move(roi_in_F);
  return estimate;
}

double covered_fraction(const std::vector<Eigen::Vector2d>& roi, const CameraModel& camera) {
  const double pixels = static_cast<double>(camera.width - 1) * static_cast<double>(camera.height - 1);
  return pixels > 0.0 ? std::min(area(roi) / pixels, 1.0) : 0.0;
}

}  // namespace cosight::overlap
