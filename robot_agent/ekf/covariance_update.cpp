#include "robot_agent/ekf/covariance_update.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <memory>

namespace cosight::ekf {
namespace {

constexpr int kLine = kernel::kPanelRows;

int panels_of(int rows) {
  return (rows + kLine - 1) / kLine;
}

}  // namespace

CovarianceUpdate::CovarianceUpdate(int state_capacity, int row_capacity)
    : CovarianceUpdate(state_capacity, row_capacity, kernel::available_kernels().back()) {}

CovarianceUpdate::CovarianceUpdate(int state_capacity, int row_capacity, const kernel::KernelSet& kernels)
    : kernels_(kernels), correction_(state_capacity), variance_(state_capacity) {
  make_room(state_capacity, row_capacity);
}

void CovarianceUpdate::make_room(int state_capacity, int row_capacity) {
  const Eigen::Index W_size = static_cast<Eigen::Index>(panels_of(state_capacity)) * kLine * row_capacity;
  L_.resize(row_capacity, row_capacity);
  whitened_.resize(row_capacity);
  panel_storage_.setZero(W_size + panels_of(state_capacity) * kLine + kLine);
  void* start = panel_storage_.data();
  auto space = static_cast<std::size_t>(panel_storage_.size()) * sizeof(double);
  W_panels_ = static_cast<double*>(std::align(kLine * sizeof(double), sizeof(double), start, space));
  correction_panels_ = W_panels_ + W_size;
}

bool CovarianceUpdate::factorise(const JointInnovation& innovation) {
  constexpr double kMinConditionalVariance = 1e-12;
  rows_ = innovation.rows();
  state_size_ = static_cast<int>(innovation.P_Ht().rows());
  panels_ = panels_of(state_size_);
  if (rows_ > L_.rows()) make_room(static_cast<int>(correction_.size()), rows_);
  auto L = L_.topLeftCorner(rows_, rows_);
  L = innovation.S_lower();
  Eigen::Ref<Eigen::MatrixXd> S(L);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S);
  if (llt.info() != Eigen::Success) return false;
  for (int i = 0; i < rows_; ++i) {
    const double conditional = L(i, i) * L(i, i);
    if (!(conditional > kMinConditionalVariance * innovation.S_lower()(i, i))) return false;
  }
  auto whitened = whitened_.head(rows_);
  whitened = innovation.g();
  L.triangularView<Eigen::Lower>().solveInPlace(whitened);
  nis_ = whitened.squaredNorm();
  kernels_.solve({innovation.P_Ht().data(), innovation.P_Ht().outerStride(), L_.data(), L_.outerStride(),
                  whitened_.data(), W_panels_, correction_panels_, panels_, rows_});
  std::copy(correction_panels_, correction_panels_ + state_size_, correction_.data());
  return std::isfinite(nis_) && correction().allFinite();
}

void CovarianceUpdate::downdate(GaussianState& state) {
  // Of the variance that goes, rounding keeps about this share either way. It is given back, or a covariance
  // that falls by more than ten orders (a long gap, then a sharp measurement) would end below zero.
  constexpr double kRounding = 1e-12;
  auto P = state.P_lower();
  auto before = variance_.head(state_size_);
  before = P.diagonal();
  kernels_.downdate({W_panels_, P.data(), P.outerStride(), panels_, rows_, state_size_});
  P.diagonal() += kRounding * (before - P.diagonal());
}

}  // namespace cosight::ekf
