#include "robot_agent/ekf/triangulation.hpp"

#include <Eigen/Geometry>
#include <cmath>
#include <numbers>

#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

/// Angle between two vectors of any length and its gradients.
struct Angle {
  double value = 0.0;  ///< [rad], in [0, pi]
  Eigen::RowVector3d d_a, d_b;
};

/// Nothing when the vectors are parallel: the gradient has no direction there.
std::optional<Angle> angle_between(const Eigen::Vector3d& a, const Eigen::Vector3d& b) {
  constexpr double kMinSine = 1e-6;
  const Eigen::Vector3d cross = a.cross(b);
  const double sine = cross.norm();  // times |a| |b|
  if (!(sine > kMinSine * a.norm() * b.norm())) return std::nullopt;
  const Eigen::Vector3d n = cross / sine;
  // Turning a towards b (n x a) shortens the angle, turning b on (n x b) widens it.
  return Angle{std::atan2(sine, a.dot(b)), -n.cross(a).transpose() / a.squaredNorm(),
               n.cross(b).transpose() / b.squaredNorm()};
}

/// d (a / |a|) / d a.
Eigen::Matrix3d unit_vector_jacobian(const Eigen::Vector3d& a) {
  const double norm = a.norm();
  return (Eigen::Matrix3d::Identity() - a * a.transpose() / (norm * norm)) / norm;
}

}  // namespace

std::optional<SineDepth> inverse_depth_by_sines(const Eigen::Vector3d& h_current,
                                                const Eigen::Vector3d& h_other, const Eigen::Vector3d& b) {
  const auto beta = angle_between(h_other, b);
  const auto gamma = angle_between(h_current, -b);
  if (!beta || !gamma) return std::nullopt;
  const double alpha = std::numbers::pi - beta->value - gamma->value;
  const double length = b.norm();
  const double sine_beta = std::sin(beta->value);
  SineDepth depth;
  depth.parallax = alpha;
  depth.rho = std::sin(alpha) / (length * sine_beta);
  const double rho_alpha = std::cos(alpha) / (length * sine_beta);
  const double rho_beta =
      -depth.rho * std::cos(beta->value) / sine_beta - rho_alpha;  // alpha falls with beta
  const double rho_gamma = -rho_alpha;
  depth.rho_h_current = rho_gamma * gamma->d_a;
  depth.rho_h_other = rho_beta * beta->d_a;
  depth.rho_b = rho_beta * beta->d_b - rho_gamma * gamma->d_b - depth.rho / (length * length) * b.transpose();
  return depth;
}

std::optional<StereoPoint> triangulate(const StereoMatch& match, const CameraModel& camera_S,
                                       const CameraModel& camera_F, const Pose& T_SF) {
  Eigen::Matrix<double, 3, 2> h_S_pixel;
  Eigen::Matrix<double, 3, 2> h_F_pixel;
  const auto h_S = camera_S.unproject(match.pixel_S, &h_S_pixel);
  const auto h_F = camera_F.unproject(match.pixel_F, &h_F_pixel);
  if (!h_S || !h_F) return std::nullopt;
  const Eigen::Matrix3d R_SF = T_SF.q.toRotationMatrix();
  const auto depth = inverse_depth_by_sines(*h_S, R_SF * *h_F, -T_SF.p);
  if (!depth || !(depth->parallax > 0.0) || !(depth->rho > 0.0)) return std::nullopt;

  StereoPoint point;
  point.rho = depth->rho;
  point.parallax = depth->parallax;
  point.ray_S = h_S->normalized();
  point.p_S = point.ray_S / point.rho;
  point.ray_pixel_S = unit_vector_jacobian(*h_S) * h_S_pixel;
  point.rho_pixels << depth->rho_h_current * h_S_pixel, depth->rho_h_other * R_SF * h_F_pixel;
  point.rho_pose << -depth->rho_b, depth->rho_h_other * rotated_point_jacobian(T_SF.q, *h_F);
  const Eigen::Vector3d p_S_rho = -point.p_S / point.rho;
  point.p_S_pixels = p_S_rho * point.rho_pixels;
  point.p_S_pixels.leftCols<2>() += point.ray_pixel_S / point.rho;
  point.p_S_pose = p_S_rho * point.rho_pose;
  return point;
}

std::optional<PointMeasurement> measure_point(const StereoMatch& match, const StereoRig& rig) {
  const auto point = triangulate(match, rig.camera_S, rig.camera_F, rig.T_SF.T);
  if (!point) return std::nullopt;
  PointMeasurement measurement;
  measurement.p_S = point->p_S;
  measurement.parallax = point->parallax;
  measurement.shared_factor =
      point->p_S_pose * position_quaternion_jacobian(rig.T_SF.T) * covariance_factor(rig.T_SF.covariance);
  const Eigen::Vector4d sigma(rig.sigma_pixel_S, rig.sigma_pixel_S, rig.sigma_pixel_F, rig.sigma_pixel_F);
  const Eigen::Matrix<double, 3, 4> from_pixels = point->p_S_pixels * sigma.asDiagonal();
  measurement.R = from_pixels * from_pixels.transpose() +
                  measurement.shared_factor * measurement.shared_factor.transpose();
  return measurement;
}

Eigen::Matrix<double, 6, 6> covariance_factor(const Eigen::Matrix<double, 6, 6>& covariance) {
  Eigen::Matrix<double, 6, 6> L = Eigen::Matrix<double, 6, 6>::Zero();
  for (int j = 0; j < 6; ++j) {
    const double variance = covariance(j, j) - L.row(j).head(j).squaredNorm();
    if (!(variance > 1e-14 * covariance(j, j))) continue;  // no error of its own left
    L(j, j) = std::sqrt(variance);
    for (int i = j + 1; i < 6; ++i) {
      L(i, j) = (covariance(i, j) - L.row(i).head(j).dot(L.row(j).head(j))) / L(j, j);
    }
  }
  return L;
}

Eigen::Matrix<double, 7, 6> position_quaternion_jacobian(const Pose& T) {
  Eigen::Matrix<double, 7, 6> J = Eigen::Matrix<double, 7, 6>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<4, 3>() = left_perturbation_jacobian(T.q);
  return J;
}

}  // namespace cosight::ekf
