#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "robot_agent/vins/parameter_blocks.hpp"

namespace cosight::vins {

/// One sighting of a landmark, as the time offset between camera and IMU moves it.
struct Sighting {
  Eigen::Vector2d point = Eigen::Vector2d::Zero();     ///< [x/z, y/z]
  Eigen::Vector2d velocity = Eigen::Vector2d::Zero();  ///< of `point` in the image [1/s]

  /// Unit vector towards the landmark had the image been taken `offset` seconds later than its stamp says.
  Eigen::Vector3d bearing(double offset) const {
    return (point - offset * velocity).homogeneous().normalized();
  }
};

/// A landmark seen from frame j, against where its first sighting from frame i and its inverse distance
/// lambda put it; residual on the tangent plane of the unit sphere (V14-V19):
///
///   h_Sj = R_SB ( R_j^T ( R_i ( R_BS f_i + lambda p_BS ) + lambda (p_i - p_j) ) - lambda p_BS )
///   r    = sqrt_information * [b1 b2]^T ( h_Sj / |h_Sj| - f_j )
///
/// h is the landmark in S_j times lambda, so that landmarks at infinity are fine. b1, b2: tangent at f_j.
/// Parameters: T_WB of i, T_WB of j, T_BS, lambda [1/m], time offset [s].
class ReprojectionFactor final : public ceres::SizedCostFunction<2, 7, 7, 7, 1, 1> {
 public:
  /// `sqrt_information`: one over the standard deviation of a bearing [1/rad].
  ReprojectionFactor(const Sighting& first, const Sighting& now, double sqrt_information);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  Sighting first_, now_;
  Eigen::Matrix<double, 2, 3> weighted_tangent_;  ///< sqrt_information * [b1 b2]^T
};

/// Two orthonormal rows, both at right angles to the unit vector `f`.
Eigen::Matrix<double, 2, 3> tangent_basis(const Eigen::Vector3d& f);

}  // namespace cosight::vins
