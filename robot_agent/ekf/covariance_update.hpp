#pragma once

#include <Eigen/Core>

#include "robot_agent/ekf/downdate_dispatch.hpp"
#include "robot_agent/ekf/gaussian_state.hpp"
#include "robot_agent/ekf/joint_innovation.hpp"

namespace cosight::ekf {

/// The Kalman update (B1-B5) in its cheapest form: with S = L L^T and W = P H^T L^-T,
///
///   K g = W (L^-1 g),    P - K S K^T = P - W W^T   (lower triangle only).
///
/// W is kept in panels of eight rows, as the kernels want it.
class CovarianceUpdate {
 public:
  CovarianceUpdate(int state_capacity, int row_capacity);
  /// With kernels of one's own choice; for tests and benchmarks.
  CovarianceUpdate(int state_capacity, int row_capacity, const kernel::KernelSet& kernels);

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
  void make_room(int state_capacity, int row_capacity);

  kernel::KernelSet kernels_;
  int state_size_ = 0;
  int panels_ = 0;
  int rows_ = 0;
  double nis_ = 0.0;
  Eigen::MatrixXd L_;
  Eigen::VectorXd panel_storage_;
  double* W_panels_ = nullptr;  ///< within panel_storage_, on a cache line
  double* correction_panels_ = nullptr;
  Eigen::VectorXd whitened_;
  Eigen::VectorXd correction_;
  Eigen::VectorXd variance_;
};

}  // namespace cosight::ekf
