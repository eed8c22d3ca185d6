#include "shared/geometry/rotation.hpp"

#include <cmath>

namespace cosight {

Eigen::Matrix3d skew(const Eigen::Vector3d& a) {
  Eigen::Matrix3d m;
  m << 0.0, -a.z(), a.y(), a.z(), 0.0, -a.x(), -a.y(), a.x(), 0.0;
  return m;
}

Eigen::Quaterniond quaternion_exp(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  const double half = 0.5 * angle;
  // sin(x/2)/x; its series keeps full precision where the quotient would not.
  const double scale = angle < 1e-4 ? 0.5 - angle * angle / 48.0 : std::sin(half) / angle;
  return {std::cos(half), scale * phi.x(), scale * phi.y(), scale * phi.z()};
}

Eigen::Vector3d quaternion_log(const Eigen::Quaterniond& q) {
  const double sign = q.w() < 0.0 ? -1.0 : 1.0;
  const Eigen::Vector3d v = sign * q.vec();
  const double sine = v.norm();
  const double cosine = sign * q.w();
  const double scale = sine < 1e-8 ? 2.0 / cosine : 2.0 * std::atan2(sine, cosine) / sine;
  return scale * v;
}

Eigen::Matrix<double, 4, 3> quaternion_exp_jacobian(const Eigen::Vector3d& phi) {
  const double angle = phi.norm();
  Eigen::Matrix<double, 4, 3> J;
  if (angle < 1e-4) {
    J.row(0) = -0.25 * phi.transpose();
    J.bottomRows<3>() =
        (0.5 - angle * angle / 48.0) * Eigen::Matrix3d::Identity() - phi * phi.transpose() / 24.0;
    return J;
  }
  const double s = std::sin(0.5 * angle);
  const double c = std::cos(0.5 * angle);
  J.row(0) = -0.5 * s / angle * phi.transpose();
  J.bottomRows<3>() = s / angle * Eigen::Matrix3d::Identity() +
                      (0.5 * c / (angle * angle) - s / (angle * angle * angle)) * phi * phi.transpose();
  return J;
}

Eigen::Matrix4d left_product_matrix(const Eigen::Quaterniond& a) {
  Eigen::Matrix4d m;
  m << a.w(), -a.x(), -a.y(), -a.z(),  //
      a.x(), a.w(), -a.z(), a.y(),     //
      a.y(), a.z(), a.w(), -a.x(),     //
      a.z(), -a.y(), a.x(), a.w();
  return m;
}

Eigen::Matrix4d right_product_matrix(const Eigen::Quaterniond& b) {
  Eigen::Matrix4d m;
  m << b.w(), -b.x(), -b.y(), -b.z(),  //
      b.x(), b.w(), b.z(), -b.y(),     //
      b.y(), -b.z(), b.w(), b.x(),     //
      b.z(), b.y(), -b.x(), b.w();
  return m;
}

Eigen::Vector4d wxyz(const Eigen::Quaterniond& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

Eigen::Quaterniond from_wxyz(const Eigen::Vector4d& q) {
  return {q(0), q(1), q(2), q(3)};
}

Eigen::Matrix<double, 3, 4> rotated_point_jacobian(const Eigen::Quaterniond& q, const Eigen::Vector3d& a) {
  // R(q) a = a + 2 w (v x a) + 2 v x (v x a), as Eigen evaluates it for a quaternion taken as it is.
  const Eigen::Vector3d v = q.vec();
  Eigen::Matrix<double, 3, 4> J;
  J.col(0) = 2.0 * v.cross(a);
  J.rightCols<3>() = -2.0 * q.w() * skew(a) + 2.0 * (v.dot(a) * Eigen::Matrix3d::Identity() +
                                                     v * a.transpose() - 2.0 * a * v.transpose());
  return J;
}

Eigen::Matrix<double, 3, 4> inverse_rotated_point_jacobian(const Eigen::Quaterniond& q,
                                                           const Eigen::Vector3d& a) {
  Eigen::Matrix<double, 3, 4> J = rotated_point_jacobian(q.conjugate(), a);
  J.rightCols<3>() *= -1.0;
  return J;
}

Eigen::Matrix4d normalisation_jacobian(const Eigen::Vector4d& q) {
  const double norm = q.norm();
  return (Eigen::Matrix4d::Identity() - q * q.transpose() / (norm * norm)) / norm;
}

Eigen::Matrix<double, 4, 3> left_perturbation_jacobian(const Eigen::Quaterniond& q) {
  return 0.5 * right_product_matrix(q).rightCols<3>();
}

Eigen::Matrix<double, 4, 3> right_perturbation_jacobian(const Eigen::Quaterniond& q) {
  return 0.5 * left_product_matrix(q).rightCols<3>();
}

}  // namespace cosight
