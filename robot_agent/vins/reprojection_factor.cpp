#include "robot_agent/vins/reprojection_factor.hpp"

#include <cmath>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Matrix3d;
using Eigen::Vector3d;
using Matrix23 = Eigen::Matrix<double, 2, 3>;
using PoseJacobian = Eigen::Matrix<double, 2, 7, Eigen::RowMajor>;

/// d (v / |v|) / d v.
Matrix3d normalisation(const Vector3d& v) {
  const double norm = v.norm();
  const Vector3d u = v / norm;
  return (Matrix3d::Identity() - u * u.transpose()) / norm;
}

/// A [v]x: each row a becomes a x v.
Matrix23 times_skew(const Matrix23& A, const Vector3d& v) {
  Matrix23 out;
  out << A.row(0).cross(v.transpose()), A.row(1).cross(v.transpose());
  return out;
}

/// d r / d theta at a stamp, from `d_theta` the time offset later: R Exp(w offset) turns by Exp(w offset)^T
/// theta where R turns by theta.
Matrix23 at_stamp(const Matrix23& d_theta, const BodyTwist& twist, double offset) {
  if (offset == 0.0) return d_theta;
  return d_theta * quaternion_exp(-offset * twist.w_B).toRotationMatrix();
}

void fill_pose(double* jacobian, const Matrix23& d_p, const Matrix23& d_theta) {
  Eigen::Map<PoseJacobian> J(jacobian);
  J.leftCols<3>() = d_p;
  J.middleCols<3>(3) = d_theta;
  J.col(6).setZero();
}

}  // namespace

Eigen::Matrix<double, 2, 3> tangent_basis(const Vector3d& f) {
  const Vector3d axis = std::abs(f.z()) < 0.9 ? Vector3d::UnitZ() : Vector3d::UnitX();
  const Vector3d b_1 = (axis - f * f.dot(axis)).normalized();
  Eigen::Matrix<double, 2, 3> basis;
  basis << b_1.transpose(), f.cross(b_1).transpose();
  return basis;
}

Vector3d host_bearing(const Sighting& first, const Eigen::Vector2d& beside) {
  return (first.bearing() + tangent_basis(first.bearing()).transpose() * beside).normalized();
}

bool HostFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  residuals[0] = sqrt_information_ * parameters[0][1];
  residuals[1] = sqrt_information_ * parameters[0][2];
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> J(jacobians[0]);
  J << 0.0, sqrt_information_, 0.0, 0.0, 0.0, sqrt_information_;
  return true;
}

ReprojectionFactor::ReprojectionFactor(const MovingSighting& first, const MovingSighting& now,
                                       double sqrt_information)
    : f_i_(first.sighting.bearing()),
      f_j_(now.sighting.bearing()),
      twist_i_(first.twist),
      twist_j_(now.twist),
      first_tangent_(tangent_basis(f_i_)),
      weighted_tangent_(sqrt_information * tangent_basis(f_j_)) {}

bool ReprojectionFactor::Evaluate(double const* const* parameters, double* residuals,
                                  double** jacobians) const {
  const double offset = *parameters[4];
  const Pose T_WBi = led_on(to_pose(parameters[0]), twist_i_, offset);
  const Pose T_WBj = led_on(to_pose(parameters[1]), twist_j_, offset);
  const Pose T_BS = to_pose(parameters[2]);
  const double lambda = *parameters[3];

  const Matrix3d R_i = T_WBi.q.toRotationMatrix();
  const Matrix3d R_j = T_WBj.q.toRotationMatrix();
  const Matrix3d R_BS = T_BS.q.toRotationMatrix();
  const Vector3d ray_i =
      f_i_ + first_tangent_.transpose() * Eigen::Map<const Eigen::Vector2d>(parameters[3] + 1);
  const Vector3d f_i = ray_i.normalized();
  const Vector3d h_Bi = R_BS * f_i + lambda * T_BS.p;
  const Vector3d h_Bj = R_j.transpose() * (R_i * h_Bi + lambda * (T_WBi.p - T_WBj.p));
  const Vector3d h_Sj = R_BS.transpose() * (h_Bj - lambda * T_BS.p);
  const double norm = h_Sj.norm();
  const Vector3d f_h = h_Sj / norm;
  Eigen::Map<Eigen::Vector2d>(residuals).noalias() = weighted_tangent_ * (f_h - f_j_);
  if (jacobians == nullptr) return true;

  const Matrix23 d_h =
      (weighted_tangent_ - (weighted_tangent_ * f_h) * f_h.transpose()) / norm;  // d r / d h_Sj
  const Matrix23 d_Bj = d_h * R_BS.transpose();                                  // d r / d h_Bj
  const Matrix23 d_W = d_Bj * R_j.transpose();
  const Matrix23 d_Bi = d_W * R_i;
  if (jacobians[0] != nullptr) {
    fill_pose(jacobians[0], lambda * d_W, at_stamp(-times_skew(d_Bi, h_Bi), twist_i_, offset));
  }
  if (jacobians[1] != nullptr) {
    fill_pose(jacobians[1], -lambda * d_W, at_stamp(times_skew(d_Bj, h_Bj), twist_j_, offset));
  }
  if (jacobians[2] != nullptr) {
    fill_pose(jacobians[2], lambda * (d_Bi - d_Bj), times_skew(d_h, h_Sj) - times_skew(d_Bi * R_BS, f_i));
  }
  if (jacobians[3] != nullptr) {
    Eigen::Map<Eigen::Matrix<double, 2, 3, Eigen::RowMajor>> J(jacobians[3]);
    J.col(0) = d_Bi * T_BS.p + d_W * (T_WBi.p - T_WBj.p) - d_Bj * T_BS.p;
    J.rightCols<2>() = d_Bi * R_BS * normalisation(ray_i) * first_tangent_.transpose();
  }
  if (jacobians[4] != nullptr) {
    Eigen::Map<Eigen::Vector2d>(jacobians[4]).noalias() = d_W * (lambda * (twist_i_.v_W - twist_j_.v_W)) +
                                                          d_Bi * twist_i_.w_B.cross(h_Bi) -
                                                          d_Bj * twist_j_.w_B.cross(h_Bj);
  }
  return true;
}

}  // namespace cosight::vins
