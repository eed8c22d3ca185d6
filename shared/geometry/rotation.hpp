#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cosight {

/// [a]x, so that skew(a) * b = a x b.
Eigen::Matrix3d skew(const Eigen::Vector3d& a);

/// Unit quaternion (Hamilton) of the rotation vector `phi` [rad]; exact limit at zero.
Eigen::Quaterniond quaternion_exp(const Eigen::Vector3d& phi);

/// Rotation vector [rad], |phi| <= pi, of a unit quaternion; q and -q give the same vector.
Eigen::Vector3d quaternion_log(const Eigen::Quaterniond& q);

/// d quaternion_exp(phi) / d phi, rows in the order (w, x, y, z).
Eigen::Matrix<double, 4, 3> quaternion_exp_jacobian(const Eigen::Vector3d& phi);

/// a (x) b = left_product_matrix(a) * b, quaternions as (w, x, y, z).
Eigen::Matrix4d left_product_matrix(const Eigen::Quaterniond& a);

/// a (x) b = right_product_matrix(b) * a, quaternions as (w, x, y, z).
Eigen::Matrix4d right_product_matrix(const Eigen::Quaterniond& b);

/// (w, x, y, z), the order of every quaternion block inside the estimators. On the wire it is (x, y, z, w).
Eigen::Vector4d wxyz(const Eigen::Quaterniond& q);
Eigen::Quaterniond from_wxyz(const Eigen::Vector4d& q);

/// d (R(q) a) / d q for R(q) = q.toRotationMatrix() of a quaternion that need not be of unit length by
/// rounding; columns in the order (w, x, y, z).
Eigen::Matrix<double, 3, 4> rotated_point_jacobian(const Eigen::Quaterniond& q, const Eigen::Vector3d& a);

/// d (R(q)^T a) / d q; columns in the order (w, x, y, z).
Eigen::Matrix<double, 3, 4> inverse_rotated_point_jacobian(const Eigen::Quaterniond& q,
                                                           const Eigen::Vector3d& a);

/// d (q / |q|) / d q at q, which need not be of unit length; order (w, x, y, z).
Eigen::Matrix4d normalisation_jacobian(const Eigen::Vector4d& q);

/// d q / d delta for q' = exp(delta) (x) q, delta in the parent's axes [rad]; rows (w, x, y, z).
Eigen::Matrix<double, 4, 3> left_perturbation_jacobian(const Eigen::Quaterniond& q);

/// d q / d delta for q' = q (x) exp(delta), delta in the child's axes [rad]; rows (w, x, y, z).
Eigen::Matrix<double, 4, 3> right_perturbation_jacobian(const Eigen::Quaterniond& q);

}  // namespace cosight
