#include "robot_agent/ekf/hypothesis_search.hpp"

#include <Eigen/LU>
#include <limits>
#include <utility>

namespace cosight::ekf {

template <int Block>
void HypothesisSearch<Block>::start(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& A,
                                    const Eigen::Ref<const Eigen::VectorXd>& u, double distance) {
  pairings_ = static_cast<int>(rows.size());
  pairing_rows_.assign(rows.begin(), rows.end());
  if (levels_.empty()) levels_.resize(1);
  Level& level = levels_.front();
  level.A.resize(rows.size() * rows.size());
  level.u.resize(rows.size());
  level.distance = distance;
  level.rows = static_cast<int>(u.size());
  int row_i = 0;
  for (int i = 0; i < pairings_; ++i) {
    const int rows_i = pairing_rows_[static_cast<std::size_t>(i)];
    Vector& u_i = level.u[static_cast<std::size_t>(i)];
    u_i.setZero();
    u_i.head(rows_i) = u.segment(row_i, rows_i);
    int row_j = 0;
    for (int j = 0; j < pairings_; ++j) {
      const int rows_j = pairing_rows_[static_cast<std::size_t>(j)];
      Matrix& A_ij = block(level, i, j);
      if (i == j) {
        A_ij.setIdentity();
      } else {
        A_ij.setZero();
      }
      A_ij.topLeftCorner(rows_i, rows_j) = A.block(row_i, row_j, rows_i, rows_j);
      row_j += rows_j;
    }
    row_i += rows_i;
  }
}

template <int Block>
void HypothesisSearch<Block>::eliminate(const Level& from, int k, int first, Level& to) const {
  to.A.resize(from.A.size());
  to.u.resize(from.u.size());
  const Matrix inverse = block(from, k, k).inverse();
  const Vector w = inverse * from.u[static_cast<std::size_t>(k)];
  to.distance = from.distance - w.dot(from.u[static_cast<std::size_t>(k)]);
  to.rows = from.rows - pairing_rows_[static_cast<std::size_t>(k)];
  for (int i = first; i < pairings_; ++i) {
    if (i == k || pairing_rows_[static_cast<std::size_t>(i)] == 0) continue;
    const Matrix A_ik = block(from, i, k);
    const Matrix gain = A_ik * inverse;
    to.u[static_cast<std::size_t>(i)] = from.u[static_cast<std::size_t>(i)] - A_ik * w;
    for (int j = first; j <= i; ++j) {
      if (j == k || pairing_rows_[static_cast<std::size_t>(j)] == 0) continue;
      const Matrix A_ij = block(from, i, j) - gain * block(from, k, j);
      block(to, i, j) = A_ij;
      block(to, j, i) = A_ij.transpose();
    }
  }
}

template <int Block>
void HypothesisSearch<Block>::offer(double distance, int rows, const ChiSquaredLimits& limits) {
  const double ratio = rows > 0 ? distance / limits(rows) : 0.0;
  if (ratio < best_ratio_) {
    best_ratio_ = ratio;
    best_ = branch_;
  }
}

template <int Block>
void HypothesisSearch<Block>::search_last(const Level& level, int first, const ChiSquaredLimits& limits) {
  for (int k = first; k < pairings_; ++k) {
    const int rows = pairing_rows_[static_cast<std::size_t>(k)];
    if (rows == 0) continue;
    const Vector& u = level.u[static_cast<std::size_t>(k)];
    branch_.back() = k;
    offer(level.distance - u.dot(block(level, k, k).inverse() * u), level.rows - rows, limits);
  }
}

template <int Block>
void HypothesisSearch<Block>::search_last_two(const Level& level, int first, const ChiSquaredLimits& limits) {
  const std::size_t last = branch_.size() - 1;
  for (int j = first; j < pairings_; ++j) {
    const int rows_j = pairing_rows_[static_cast<std::size_t>(j)];
    if (rows_j == 0) continue;
    const Matrix inverse = block(level, j, j).inverse();
    const Vector w = inverse * level.u[static_cast<std::size_t>(j)];
    const double distance = level.distance - w.dot(level.u[static_cast<std::size_t>(j)]);
    branch_[last - 1] = j;
    for (int k = j + 1; k < pairings_; ++k) {
      const int rows_k = pairing_rows_[static_cast<std::size_t>(k)];
      if (rows_k == 0) continue;
      const Matrix& A_jk = block(level, j, k);
      const Matrix A_kk = block(level, k, k) - A_jk.transpose() * inverse * A_jk;
      const Vector u = level.u[static_cast<std::size_t>(k)] - A_jk.transpose() * w;
      branch_[last] = k;
      offer(distance - u.dot(A_kk.inverse() * u), level.rows - rows_j - rows_k, limits);
    }
  }
}

template <int Block>
void HypothesisSearch<Block>::search(std::size_t depth, int first, int removals,
                                     const ChiSquaredLimits& limits) {
  if (removals == 1) return search_last(levels_[depth], first, limits);
  if (removals == 2) return search_last_two(levels_[depth], first, limits);
  for (int i = first; i < pairings_; ++i) {
    if (pairing_rows_[static_cast<std::size_t>(i)] == 0) continue;
    branch_[depth] = i;
    eliminate(levels_[depth], i, i + 1, levels_[depth + 1]);
    search(depth + 1, i + 1, removals - 1, limits);
  }
}

template <int Block>
bool HypothesisSearch<Block>::find_best(int removals, const ChiSquaredLimits& limits) {
  branch_.assign(static_cast<std::size_t>(removals), -1);
  best_.clear();
  best_ratio_ = std::numeric_limits<double>::infinity();
  if (levels_.size() < branch_.size()) levels_.resize(branch_.size());
  search(0, 0, removals, limits);
  return !best_.empty();
}

template <int Block>
std::optional<int> HypothesisSearch<Block>::least_probable(const ChiSquaredLimits& limits) const {
  const Level& level = levels_.front();
  std::optional<int> worst;
  double worst_ratio = 1.0;
  for (int k = 0; k < pairings_; ++k) {
    const int rows = pairing_rows_[static_cast<std::size_t>(k)];
    if (rows == 0) continue;
    const Vector& u = level.u[static_cast<std::size_t>(k)];
    const double ratio = u.dot(block(level, k, k).inverse() * u) / limits(rows);
    if (ratio <= worst_ratio) continue;
    worst_ratio = ratio;
    worst = k;
  }
  return worst;
}

template <int Block>
void HypothesisSearch<Block>::take_off(int k) {
  eliminate(levels_.front(), k, 0, scratch_);
  std::swap(levels_.front(), scratch_);
  pairing_rows_[static_cast<std::size_t>(k)] = 0;
}

template class HypothesisSearch<2>;
template class HypothesisSearch<3>;

}  // namespace cosight::ekf
