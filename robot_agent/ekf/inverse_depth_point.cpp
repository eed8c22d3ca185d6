#include "robot_agent/ekf/inverse_depth_point.hpp"

#include <cmath>
#include <limits>

namespace cosight::ekf {

Eigen::Vector3d ray_of_angles(const RayAngles& angles, Eigen::Matrix<double, 3, 2>* J) {
  const double st = std::sin(angles.theta);
  const double ct = std::cos(angles.theta);
  const double sp = std::sin(angles.phi);
  const double cp = std::cos(angles.phi);
  if (J != nullptr) {
    J->col(0) << -cp * st, cp * ct, 0.0;
    J->col(1) << -sp * ct, -sp * st, cp;
  }
  return {cp * ct, cp * st, sp};
}

std::optional<RayAngles> angles_of_ray(const Eigen::Vector3d& ray_W, Eigen::Matrix<double, 2, 3>* J) {
  constexpr double kMinSineFromVertical = 1e-6;
  const double length2 = ray_W.squaredNorm();
  const double horizontal2 = ray_W.head<2>().squaredNorm();
  if (!(horizontal2 > kMinSineFromVertical * kMinSineFromVertical * length2)) return std::nullopt;
  const double horizontal = std::sqrt(horizontal2);
  if (J != nullptr) {
    J->row(0) << -ray_W.y() / horizontal2, ray_W.x() / horizontal2, 0.0;
    const double scale = -ray_W.z() / (horizontal * length2);
    J->row(1) << scale * ray_W.x(), scale * ray_W.y(), horizontal / length2;
  }
  return RayAngles{std::atan2(ray_W.y(), ray_W.x()), std::atan2(ray_W.z(), horizontal)};
}

Eigen::Vector3d InverseDepthPoint::p_W(Eigen::Matrix<double, 3, kDim>* J) const {
  Eigen::Matrix<double, 3, 2> m_angles;
  const Eigen::Vector3d m = ray_W(&m_angles);
  if (J != nullptr) {
    J->leftCols<3>().setIdentity();
    J->middleCols<2>(kTheta) = m_angles / rho;
    J->col(kRho) = -m / (rho * rho);
  }
  return anchor_W + m / rho;
}

double depth_nonlinearity(const InverseDepthPoint& y, double sigma_rho, const Eigen::Vector3d& r_WS) {
  if (!(y.rho > 0.0)) return std::numeric_limits<double>::infinity();
  const Eigen::Vector3d h_1 = y.p_W() - r_WS;
  const double d_1 = h_1.norm();
  const double cosine = y.ray_W().dot(h_1) / d_1;
  return 4.0 * sigma_rho / (y.rho * y.rho) / d_1 * std::abs(cosine);
}

}  // namespace cosight::ekf
