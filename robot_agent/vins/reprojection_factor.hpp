#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>
#include <array>

#include "robot_agent/vins/parameter_blocks.hpp"

namespace cosight::vins {

/// One sighting of a landmark.
struct Sighting {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();  ///< [x/z, y/z]

  /// Unit vector towards the landmark.
  Eigen::Vector3d bearing() const { return point.homogeneous().normalized(); }
};

/// A sighting, and how the body moved at it.
struct MovingSighting {
  Sighting sighting;
  BodyTwist twist = {};
};

/// What is estimated of a landmark: [lambda (1/m), a, b]; a, b: how far it lies beside its first sighting, in
/// that one's tangent plane [rad]. The paper takes a = b = 0, as if the first sighting were without noise;
/// its error is then in all residuals of the landmark at once, and the window believes itself too much.
using LandmarkBlock = std::array<double, 3>;

/// Unit vector towards a landmark from its host: f_i = (f(first) + [b1 b2] [a b]^T) / | |.
Eigen::Vector3d host_bearing(const Sighting& first, const Eigen::Vector2d& beside);

/// A landmark seen from frame j, against where its host i and its inverse distance lambda put it; residual on
/// the tangent plane of the unit sphere (V14-V19):
///
///   h_Sj = R_SB ( R_j^T ( R_i ( R_BS f_i + lambda p_BS ) + lambda (p_i - p_j) ) - lambda p_BS )
///   r    = sqrt_information * [b1 b2]^T ( h_Sj / |h_Sj| - f_j )
///
/// h is the landmark in S_j times lambda, so that landmarks at infinity are fine. b1, b2: tangent at f_j.
/// i and j are the body when the images were really taken, the time offset later than at their stamps: there
/// by the twists of the two frames, which count as known. VINS-Mono moves the sightings instead, by their
/// velocities in the image. Those are differences of noisy sightings, so that an offset of half a period has
/// the least noise, and is found where the frames are far apart.
/// Parameters: T_WB of i, T_WB of j, T_BS, LandmarkBlock, time offset [s].
class ReprojectionFactor final : public ceres::SizedCostFunction<2, 7, 7, 7, 3, 1> {
 public:
  /// `sqrt_information`: one over the standard deviation of a bearing [1/rad].
  ReprojectionFactor(const MovingSighting& first, const MovingSighting& now, double sqrt_information);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Eigen::Vector3d f_i_, f_j_;  ///< bearings of the two sightings
  BodyTwist twist_i_, twist_j_;
  Eigen::Matrix<double, 2, 3> first_tangent_;     ///< of the first sighting
  Eigen::Matrix<double, 2, 3> weighted_tangent_;  ///< sqrt_information * [b1 b2]^T
};

/// The first sighting itself: r = sqrt_information [a b]. Parameters: LandmarkBlock.
class HostFactor final : public ceres::SizedCostFunction<2, 3> {
 public:
  explicit HostFactor(double sqrt_information) : sqrt_information_(sqrt_information) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  double sqrt_information_;
};

/// Two orthonormal rows, both at right angles to the unit vector `f`.
Eigen::Matrix<double, 2, 3> tangent_basis(const Eigen::Vector3d& f);

}  // namespace cosight::vins
