#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot_agent/ekf/triangulation.hpp"

namespace cosight::slam {

/// A match as two unit rays, with what a pixel of noise does to each.
struct RayPair {
  Eigen::Vector3d m_S, m_F;
  Eigen::Matrix<double, 3, 2> J_S, J_F;
};

/// Nothing where a pixel has no ray.
std::optional<RayPair> rays_of(const ekf::StereoRig& rig, const ekf::StereoMatch& match);

/// How far a match is from the epipolar constraint, in its own standard deviations.
struct EpipolarError {
  double value = 0.0;             ///< t . (m_S x R m_F) / sigma
  Eigen::Matrix<double, 1, 6> J;  ///< by [dp, dtheta] of T_SF in the axes of S, at a fixed sigma
};

/// `variance_S`, `variance_F`: of the pixels [px^2]. Zero at a pose for which neither pixel matters.
EpipolarError epipolar_error(const RayPair& pair, const Pose& T_SF, double variance_S, double variance_F);

}  // namespace cosight::slam
