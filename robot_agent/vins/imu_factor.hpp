#pragma once

#include <ceres/sized_cost_function.h>

#include "robot_agent/vins/parameter_blocks.hpp"
#include "robot_agent/vins/preintegration.hpp"

namespace cosight::vins {

/// What two neighbouring frames i, j say against the IMU between them (V13), whitened by its covariance:
///
///   r_alpha = R_i^T (p_j - p_i - v_i dt + g_W dt^2 / 2) - alpha(b_i)
///   r_theta = 2 vec( gamma(b_i)^-1 q_i^-1 q_j )
///   r_beta  = R_i^T (v_j - v_i + g_W dt) - beta(b_i)
///   r_ba = ba_j - ba_i,   r_bg = bg_j - bg_i
///
/// Parameters: pose i, motion i, pose j, motion j (see parameter_blocks.hpp).
class ImuFactor final : public ceres::SizedCostFunction<15, 7, 9, 7, 9> {
 public:
  /// `imu` must outlive the factor.
  ImuFactor(const Preintegration& imu, double gravity);

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const Preintegration& imu_;
  Eigen::Vector3d g_W_;
  Preintegration::Matrix sqrt_information_;  ///< upper triangular U, U^T U = covariance^-1
};

}  // namespace cosight::vins
