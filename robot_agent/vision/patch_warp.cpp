#include "robot_agent/vision/patch_warp.hpp"

#include <cmath>

namespace cosight::vision {

// With d the reference ray [x y 1] through pixel u and n the plane's normal, the plane's point on the ray is
// p = d (n.p0 / n.d), so dp/du = depth (I - d n^T / n.d) dd/du; then into the present camera and its pixels.
std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W, PatchNormal normal) {
  const Pose T_RW = reference.T_WC.inverse();
  const Pose T_PW = present.T_WC.inverse();
  const Eigen::Vector3d p_R = T_RW * p_W;
  const Eigen::Vector3d p_P = T_PW * p_W;
  Eigen::Matrix<double, 2, 3> J_project;
  if (!present.camera.project(p_P, &J_project)) return std::nullopt;
  const auto pixel_R = reference.camera.project(p_R);
  if (!pixel_R) return std::nullopt;
  Eigen::Matrix<double, 3, 2> J_ray;
  const auto ray_R = reference.camera.unproject(*pixel_R, &J_ray);
  if (!ray_R) return std::nullopt;

  const Eigen::Matrix3d R_PR = (T_PW.q * reference.T_WC.q).toRotationMatrix();
  const Eigen::Vector3d sight_from_P = R_PR.transpose() * p_P.normalized();
  Eigen::Vector3d n_R = p_R.normalized();
  if (normal == PatchNormal::kTowardsMean) n_R = (n_R + sight_from_P).normalized();
  constexpr double kEdgeOn = 0.1;  // cosine between line of sight and normal
  const double cosine = n_R.dot(*ray_R);
  if (!(n_R.dot(sight_from_P) > kEdgeOn) || !(cosine > kEdgeOn)) return std::nullopt;
  const Eigen::Matrix3d onto_plane = Eigen::Matrix3d::Identity() - *ray_R * n_R.transpose() / cosine;
  return J_project * R_PR * (p_R.z() * onto_plane * J_ray);
}

}  // namespace cosight::vision
