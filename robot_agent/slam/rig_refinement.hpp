#pragma once

#include <cstdint>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/ekf/triangulation.hpp"
#include "robot_agent/wearer/uncertain_angle.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::slam {

struct RigRefinementOptions {
  int hypotheses = 100;          ///< RANSAC samples of three matches each
  double gate_sigmas = 3.0;      ///< of a match's own epipolar error
  double mismatch_px = 0.7;      ///< of a match beyond its pixel noise: what the warp leaves of perspective
  int independent_matches = 10;  ///< more do not make it better: lens and surfaces err alike in neighbours
  int min_inliers = 6;           ///< fewer say nothing that chance could not
  double min_inlier_share = 0.35;
  double max_prior_distance = 22.5;  ///< squared, from the sensors' pose: 99.9 % of six degrees of freedom
  std::uint32_t seed = 1;
};

/// What the matches of one frame say of the pose of Cf.
struct RefinedRig {
  UncertainPose T_SF;
  std::vector<char> is_inlier;  ///< one entry a match
  int inliers = 0;
};

/// The pose of Cf from what the sensors say (`rig.T_SF`, its covariance the prior) and from the epipolar
/// constraint of matches between the two images, which know nothing of depth:
///
///   T_SF = argmin |xi|^2_Sigma + sum_i rho( e_i(T_SF_hat (+) xi)^2 / sigma_i^2 ),   e = t . (m_S x R m_F)
///
/// with m the unit rays and sigma_i from the pixels' noise. The length of t stays what the sensors say.
/// Nothing when too few matches agree.
std::optional<RefinedRig> refine_rig(const ekf::StereoRig& rig, std::span<const ekf::StereoMatch> matches,
                                     const RigRefinementOptions& options = {});

/// What the matches alone say of Cf's yaw in W, from the sensed pose [rad]. The refined pose holds what the
/// sensors say as well: with variances p before and q after, 1/r = 1/q - 1/p, and the step from the sensed
/// yaw grows by p/(p-q). Nothing where the matches say little.
std::optional<wearer::UncertainAngle> yaw_by_matches(const UncertainPose& sensed,
                                                     const UncertainPose& refined,
                                                     const Eigen::Matrix3d& R_WS);

}  // namespace cosight::slam
