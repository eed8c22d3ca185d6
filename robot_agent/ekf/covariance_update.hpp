#pragma once

#include <Eigen/Core>

#include "robot_agent/ekf/gaussian_state.hpp"
#include "robot_agent/ekf/joint_innovation.hpp"

namespace cosight::ekf {

/// The Kalman update (B1-B5) in its cheapest form: with S = L L^T and W = P H^T L^-T,
///
///   K g = W (L^-1 g),    P - K S K^T = P - W W^T   (lower triangle only).
class CovarianceUpdate {
 public:
  CovarianceUpdate(int state_capacity, int row_capacity);

  /// Factorises S and solves for W. False when S is not safely positive definite: a row whose variance, given
  /// the rows before it, is less than 1e-12 of what it was. Then nothing else may be asked.
  bool factorise(const JointInnovation& innovation);

  /// W (L^-1 g) [units of x].
  auto correction() const { return correction_.head(state_size_); }
  /// g^T S^-1 g.
  double nis() const { return nis_; }

  /// P -= W W^T, less the rounding of what is taken away.
  void downdate(GaussianState& state);

 private:
  int state_size_ = 0;
  int rows_ = 0;
  double nis_ = 0.0;
  Eigen::MatrixXd L_;
  Eigen::MatrixXd W_;
  Eigen::VectorXd whitened_;
  Eigen::VectorXd correction_;
  Eigen::VectorXd variance_;
};

}  // namespace cosight::ekf
