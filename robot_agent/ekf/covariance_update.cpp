#include "robot_agent/ekf/covariance_update.hpp"

#include <Eigen/Cholesky>

namespace cosight::ekf {

CovarianceUpdate::CovarianceUpdate(int state_capacity, int row_capacity)
    : L_(row_capacity, row_capacity),
      W_(state_capacity, row_capacity),
      whitened_(row_capacity),
      correction_(state_capacity),
      variance_(state_capacity) {}

bool CovarianceUpdate::factorise(const JointInnovation& innovation) {
  constexpr double kMinConditionalVariance = 1e-12;
  rows_ = innovation.rows();
  state_size_ = static_cast<int>(innovation.P_Ht().rows());
  if (rows_ > L_.rows()) {
    L_.resize(rows_, rows_);
    W_.resize(W_.rows(), rows_);
    whitened_.resize(rows_);
  }
  auto L = L_.topLeftCorner(rows_, rows_);
  L = innovation.S_lower();
  Eigen::Ref<Eigen::MatrixXd> S(L);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S);
  if (llt.info() != Eigen::Success) return false;
  for (int i = 0; i < rows_; ++i) {
    const double conditional = L(i, i) * L(i, i);
    if (!(conditional > kMinConditionalVariance * innovation.S_lower()(i, i))) return false;
  }
  auto W = W_.topLeftCorner(state_size_, rows_);
  W = innovation.P_Ht();
  L.triangularView<Eigen::Lower>().transpose().solveInPlace<Eigen::OnTheRight>(W);
  auto whitened = whitened_.head(rows_);
  whitened = innovation.g();
  L.triangularView<Eigen::Lower>().solveInPlace(whitened);
  nis_ = whitened.squaredNorm();
  correction_.head(state_size_).noalias() = W * whitened;
  return std::isfinite(nis_) && correction().allFinite();
}

void CovarianceUpdate::downdate(GaussianState& state) {
  // Of the variance that goes, rounding keeps about this share either way. It is given back, or a covariance
  // that falls by more than ten orders (a long gap, then a sharp measurement) would end below zero.
  constexpr double kRounding = 1e-12;
  auto P = state.P_lower();
  auto before = variance_.head(state_size_);
  before = P.diagonal();
  P.selfadjointView<Eigen::Lower>().rankUpdate(W_.topLeftCorner(state_size_, rows_), -1.0);
  P.diagonal() += kRounding * (before - P.diagonal());
}

}  // namespace cosight::ekf
