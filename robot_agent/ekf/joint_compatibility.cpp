#include "robot_agent/ekf/joint_compatibility.hpp"

#include <Eigen/Cholesky>
#include <Eigen/LU>
#include <algorithm>
#include <optional>

namespace cosight::ekf {
namespace {

constexpr int kTabulatedRows = 600;
constexpr int kMaxPairingRows = 3;

}  // namespace

JointCompatibility::JointCompatibility(const JointCompatibilityOptions& options)
    : options_(options),
      limits_(options.probability, kTabulatedRows),
      each_limits_(options.each_probability, kMaxPairingRows) {}

const Hypothesis& JointCompatibility::test(const JointInnovation& innovation) {
  pairing_rows_.clear();
  for (const LinearisedMeasurement& m : innovation.measurements())
    pairing_rows_.push_back(m.rows);
  const auto pairings = pairing_rows_.size();
  hypothesis_ = Hypothesis{std::move(hypothesis_.keep)};
  hypothesis_.keep.assign(pairings, 1);
  hypothesis_.rows = innovation.rows();
  hypothesis_.limit = limits_(hypothesis_.rows);
  if (pairings == 0) return hypothesis_;
  if (!factorise(innovation)) {
    hypothesis_.keep.assign(pairings, 0);
    hypothesis_.removed = static_cast<int>(pairings);
    hypothesis_.rows = 0;
    hypothesis_.limit = 0.0;
    hypothesis_.exact = false;
    return hypothesis_;
  }
  hypothesis_.distance = whitened_storage_.head(rows_).squaredNorm();
  const bool compatible = hypothesis_.distance <= hypothesis_.limit;
  if (compatible && options_.each_probability >= 1.0) return hypothesis_;
  invert_factor();
  if (compatible && each_is_probable()) return hypothesis_;
  if (std::ranges::all_of(pairing_rows_, [](int rows) { return rows == 2; })) {
    select(pixels_);
  } else {
    select(mixed_);
  }
  return hypothesis_;
}

/// Room for the largest innovation so far: what is smaller uses a corner of it.
void JointCompatibility::make_room(int rows) {
  if (rows <= L_storage_.rows()) return;
  L_storage_.resize(rows, rows);
  L_inverse_storage_.resize(rows, rows);
  A_storage_.resize(rows, rows);
  whitened_storage_.resize(rows);
  u_storage_.resize(rows);
}

/// S = L L^T and L^-1 g.
bool JointCompatibility::factorise(const JointInnovation& innovation) {
  rows_ = innovation.rows();
  make_room(rows_);
  auto L = L_storage_.topLeftCorner(rows_, rows_);
  L = innovation.S_lower();
  Eigen::Ref<Eigen::MatrixXd> S(L);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S);
  if (llt.info() != Eigen::Success) return false;
  auto whitened = whitened_storage_.head(rows_);
  whitened = innovation.g();
  L.triangularView<Eigen::Lower>().solveInPlace(whitened);
  return whitened.allFinite();
}

/// L^-1, a panel of columns at a time from its first row that is not zero, and u = S^-1 g = L^-T L^-1 g.
void JointCompatibility::invert_factor() {
  constexpr int kPanel = 16;
  const auto L = L_storage_.topLeftCorner(rows_, rows_);
  auto L_inverse = L_inverse_storage_.topLeftCorner(rows_, rows_);
  L_inverse.setIdentity();
  for (int i = 0; i < rows_; i += kPanel) {
    auto panel = L_inverse.block(i, i, rows_ - i, std::min(kPanel, rows_ - i));
    L.bottomRightCorner(rows_ - i, rows_ - i).triangularView<Eigen::Lower>().solveInPlace(panel);
  }
  for (int i = 0; i < rows_; ++i) {
    u_storage_(i) = L_inverse.col(i).tail(rows_ - i).dot(whitened_storage_.segment(i, rows_ - i));
  }
}

/// The usual case, and all of A is not needed for it: A_kk is a product of the columns of L^-1.
bool JointCompatibility::each_is_probable() const {
  Eigen::Index row = 0;
  for (const int rows : pairing_rows_) {
    const auto columns = L_inverse_storage_.block(row, row, rows_ - row, rows);
    Eigen::Matrix3d A_kk = Eigen::Matrix3d::Identity();
    A_kk.topLeftCorner(rows, rows) = columns.transpose().lazyProduct(columns);
    Eigen::Vector3d u_k = Eigen::Vector3d::Zero();
    u_k.head(rows) = u_storage_.segment(row, rows);
    if (!(u_k.dot(A_kk.inverse() * u_k) <= each_limits_(rows))) return false;
    row += rows;
  }
  return true;
}

template <int Block>
void JointCompatibility::take_off(HypothesisSearch<Block>& search, std::span<const int> pairings) {
  for (const int k : pairings) {
    search.take_off(k);
    hypothesis_.keep[static_cast<std::size_t>(k)] = 0;
    ++hypothesis_.removed;
  }
  hypothesis_.rows = search.rows();
  hypothesis_.distance = hypothesis_.rows > 0 ? search.distance() : 0.0;
  hypothesis_.limit = limits_(hypothesis_.rows);
}

template <int Block>
void JointCompatibility::select(HypothesisSearch<Block>& search) {
  auto A = A_storage_.topLeftCorner(rows_, rows_);
  A.setZero();
  A.selfadjointView<Eigen::Lower>().rankUpdate(L_inverse_storage_.topLeftCorner(rows_, rows_).transpose());
  A.triangularView<Eigen::StrictlyUpper>() = A.transpose();
  search.start(pairing_rows_, A, u_storage_.head(rows_), hypothesis_.distance);
  if (hypothesis_.distance > hypothesis_.limit) find_compatible(search);
  if (options_.each_probability < 1.0) drop_improbable(search);
}

template <int Block>
void JointCompatibility::find_compatible(HypothesisSearch<Block>& search) {
  const int pairings = static_cast<int>(pairing_rows_.size());
  const int exact = std::min(options_.exact_removals, pairings);
  for (int removals = 1; removals <= exact; ++removals) {
    search.find_best(removals, limits_);
    if (search.best_ratio() <= 1.0) return take_off(search, search.best());
  }
  hypothesis_.exact = false;
  if (exact > 0) take_off(search, search.best());
  while (hypothesis_.rows > 0 && hypothesis_.distance > hypothesis_.limit) {
    search.find_best(1, limits_);
    take_off(search, search.best());
  }
}

template <int Block>
void JointCompatibility::drop_improbable(HypothesisSearch<Block>& search) {
  while (const std::optional<int> worst = search.least_probable(each_limits_)) {
    take_off(search, {&*worst, 1});
    ++hypothesis_.improbable;
  }
}

}  // namespace cosight::ekf
