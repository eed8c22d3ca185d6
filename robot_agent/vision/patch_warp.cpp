#include "robot_agent/vision/patch_warp.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

namespace cosight::vision {

namespace {

/// A point as both views have it.
struct Sight {
  Eigen::Vector3d p_R, p_P;
  Eigen::Matrix3d R_PR;
  Eigen::Vector3d from_R, from_P;  ///< unit lines of sight, both in the axes of R
};

Sight sight_of(const View& reference, const View& present, const Eigen::Vector3d& p_W) {
  const Pose T_RW = reference.T_WC.inverse();
  const Pose T_PW = present.T_WC.inverse();
  Sight sight;
  sight.p_R = T_RW * p_W;
  sight.p_P = T_PW * p_W;
  sight.R_PR = (T_PW.q * reference.T_WC.q).toRotationMatrix();
  sight.from_R = sight.p_R.normalized();
  sight.from_P = sight.R_PR.transpose() * sight.p_P.normalized();
  return sight;
}

// With d the reference ray [x y 1] through pixel u and n the plane's normal, the plane's point on the ray is
// p = d (n.p0 / n.d), so dp/du = depth (I - d n^T / n.d) dd/du; then into the present camera and its pixels.
std::optional<Eigen::Matrix2d> warp_of_plane(const View& reference, const View& present, const Sight& sight,
                                             const Eigen::Vector3d& n_R) {
  Eigen::Matrix<double, 2, 3> J_project;
  if (!present.camera.project(sight.p_P, &J_project)) return std::nullopt;
  const auto pixel_R = reference.camera.project(sight.p_R);
  if (!pixel_R) return std::nullopt;
  Eigen::Matrix<double, 3, 2> J_ray;
  const auto ray_R = reference.camera.unproject(*pixel_R, &J_ray);
  if (!ray_R) return std::nullopt;
  constexpr double kEdgeOn = 0.1;  // cosine between line of sight and normal
  const double cosine = n_R.dot(*ray_R);
  if (!(n_R.dot(sight.from_P) > kEdgeOn) || !(cosine > kEdgeOn)) return std::nullopt;
  const Eigen::Matrix3d onto_plane = Eigen::Matrix3d::Identity() - *ray_R * n_R.transpose() / cosine;
  return J_project * sight.R_PR * (sight.p_R.z() * onto_plane * J_ray);
}

}  // namespace

std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W) {
  const Sight sight = sight_of(reference, present, p_W);
  return warp_of_plane(reference, present, sight, sight.from_R);
}

std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W, const Eigen::Vector3d& normal_W) {
  const Sight sight = sight_of(reference, present, p_W);
  const Eigen::Vector3d n_R = reference.T_WC.q.conjugate() * normal_W;
  return warp_of_plane(reference, present, sight, n_R.dot(sight.from_R) < 0.0 ? Eigen::Vector3d(-n_R) : n_R);
}

std::array<Eigen::Vector3d, kSurfaces> surfaces_along(const Eigen::Vector3d& ray, const Eigen::Vector3d& up) {
  constexpr double kTurn = 60.0 * std::numbers::pi / 180.0;
  const Eigen::Vector3d sight = ray.normalized();
  const Eigen::AngleAxisd left(kTurn, up);
  const Eigen::AngleAxisd right(-kTurn, up);
  return {sight, left * sight, right * sight, up};
}

}  // namespace cosight::vision
