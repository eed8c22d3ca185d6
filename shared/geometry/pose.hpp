#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

namespace cosight {

/// A rigid transform. Named `T_AB` it maps points from B to A: p_A = T_AB * p_B [m].
struct Pose {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();  ///< rotation R_AB, Hamilton
  Eigen::Vector3d p = Eigen::Vector3d::Zero();            ///< origin of B in A [m]

  Eigen::Vector3d operator*(const Eigen::Vector3d& p_B) const { return q * p_B + p; }
  Pose operator*(const Pose& T_BC) const { return {(q * T_BC.q).normalized(), q * T_BC.p + p}; }
  Pose inverse() const { return {q.conjugate(), -(q.conjugate() * p)}; }
};

}  // namespace cosight
