#include "robot_agent/ekf/joint_compatibility.hpp"

#include <Eigen/Cholesky>
#include <algorithm>

namespace cosight::ekf {
namespace {

constexpr int kTabulatedRows = 600;

}  // namespace

JointCompatibility::JointCompatibility(const JointCompatibilityOptions& options)
    : options_(options), limits_(options.probability, kTabulatedRows) {}

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
  hypothesis_.distance = whitened_.squaredNorm();
  if (hypothesis_.distance <= hypothesis_.limit) return hypothesis_;
  invert();
  if (std::ranges::all_of(pairing_rows_, [](int rows) { return rows == 2; })) {
    search(pixels_);
  } else {
    search(mixed_);
  }
  return hypothesis_;
}

/// S = L L^T and L^-1 g.
bool JointCompatibility::factorise(const JointInnovation& innovation) {
  L_ = innovation.S_lower();
  Eigen::Ref<Eigen::MatrixXd> S(L_);
  const Eigen::LLT<Eigen::Ref<Eigen::MatrixXd>> llt(S);
  if (llt.info() != Eigen::Success) return false;
  whitened_ = innovation.g();
  auto whitened = whitened_.head(innovation.rows());
  L_.triangularView<Eigen::Lower>().solveInPlace(whitened);
  return whitened_.allFinite();
}

/// A = S^-1 = L^-T L^-1 (both triangles) and u = A g.
void JointCompatibility::invert() {
  L_inverse_.setIdentity(L_.rows(), L_.cols());
  L_.triangularView<Eigen::Lower>().solveInPlace(L_inverse_);
  A_.setZero(L_.rows(), L_.cols());
  A_.selfadjointView<Eigen::Lower>().rankUpdate(L_inverse_.transpose());
  A_.triangularView<Eigen::StrictlyUpper>() = A_.transpose();
  u_.resize(whitened_.size());
  for (Eigen::Index i = 0; i < u_.size(); ++i)
    u_(i) = L_inverse_.col(i).dot(whitened_);
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
void JointCompatibility::search(HypothesisSearch<Block>& search) {
  const int pairings = static_cast<int>(pairing_rows_.size());
  search.start(pairing_rows_, A_, u_, hypothesis_.distance);
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

}  // namespace cosight::ekf
