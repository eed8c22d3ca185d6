#include "robot_agent/slam/epipolar_error.hpp"

#include <Eigen/Geometry>
#include <cmath>

namespace cosight::slam {

std::optional<RayPair> rays_of(const ekf::StereoRig& rig, const ekf::StereoMatch& match) {
  RayPair pair;
  const auto m_S = rig.camera_S.unproject(match.pixel_S, &pair.J_S);
  const auto m_F = rig.camera_F.unproject(match.pixel_F, &pair.J_F);
  if (!m_S || !m_F) return std::nullopt;
  pair.m_S = *m_S;
  pair.m_F = *m_F;
  return pair;
}

EpipolarError epipolar_error(const RayPair& pair, const Pose& T_SF, double variance_S, double variance_F) {
  const Eigen::Matrix3d R = T_SF.q.toRotationMatrix();
  const Eigen::Vector3d n = R * pair.m_F;
  const Eigen::Vector3d c = pair.m_S.cross(n);
  const Eigen::Vector3d t_m = T_SF.p.cross(pair.m_S);
  const Eigen::RowVector2d by_S = n.cross(T_SF.p).transpose() * pair.J_S;
  const Eigen::RowVector2d by_F = (R.transpose() * t_m).transpose() * pair.J_F;
  const double variance = variance_S * by_S.squaredNorm() + variance_F * by_F.squaredNorm();
  const double weight = variance > 0.0 ? 1.0 / std::sqrt(variance) : 0.0;
  EpipolarError error;
  error.value = weight * T_SF.p.dot(c);
  error.J << weight * c.transpose(), weight * n.cross(t_m).transpose();
  return error;
}

}  // namespace cosight::slam
