#pragma once

#include <Eigen/Core>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/ekf/chi_squared.hpp"

namespace cosight::ekf {

/// Which pairings to take off so that the rest is as compatible as can be, from A = S^-1 and u = A g.
///
/// Taking pairing k off is a Schur complement: D^2 -= u_k^T A_kk^-1 u_k, u_j -= A_jk A_kk^-1 u_k,
/// A_ij -= A_ik A_kk^-1 A_kj. Every hypothesis is reached from one with a pairing more, so it costs one small
/// block. `Block`: rows of a pairing (2, or 3 with pairings of two rows padded by an independent, exact
/// third).
template <int Block>
class HypothesisSearch {
 public:
  using Matrix = Eigen::Matrix<double, Block, Block>;
  using Vector = Eigen::Matrix<double, Block, 1>;

  /// Starts with all pairings on. `rows` of each pairing (2 or 3); A is full and symmetric, u = A g.
  void start(std::span<const int> rows, const Eigen::Ref<const Eigen::MatrixXd>& A,
             const Eigen::Ref<const Eigen::VectorXd>& u, double distance);

  /// The set of exactly `removals` pairings whose removal leaves the smallest distance in parts of its limit.
  /// False when there are not so many pairings.
  bool find_best(int removals, const ChiSquaredLimits& limits);
  std::span<const int> best() const { return best_; }
  double best_ratio() const { return best_ratio_; }

  /// Of the pairings outside their own limit given all others that are on, the one farthest outside.
  std::optional<int> least_probable(const ChiSquaredLimits& limits) const;

  /// Takes pairing `k` off for good.
  void take_off(int k);
  double distance() const { return levels_.front().distance; }
  int rows() const { return levels_.front().rows; }

 private:
  struct Level {
    std::vector<Matrix> A;  ///< block (i, j) at i * pairings + j; both triangles
    std::vector<Vector> u;
    double distance = 0.0;
    int rows = 0;
  };

  std::size_t at(int i, int j) const {
    return static_cast<std::size_t>(i) * static_cast<std::size_t>(pairings_) + static_cast<std::size_t>(j);
  }
  Matrix& block(Level& level, int i, int j) const { return level.A[at(i, j)]; }
  const Matrix& block(const Level& level, int i, int j) const { return level.A[at(i, j)]; }
  void eliminate(const Level& from, int k, int first, Level& to) const;
  void search(std::size_t depth, int first, int removals, const ChiSquaredLimits& limits);
  void search_last(const Level& level, int first, const ChiSquaredLimits& limits);
  void search_last_two(const Level& level, int first, const ChiSquaredLimits& limits);
  void offer(double distance, int rows, const ChiSquaredLimits& limits);

  int pairings_ = 0;
  std::vector<int> pairing_rows_;  ///< zero: off
  std::vector<Level> levels_;      ///< by how many pairings are off in the present branch
  Level scratch_;
  std::vector<int> branch_;
  std::vector<int> best_;
  double best_ratio_ = 0.0;
};

extern template class HypothesisSearch<2>;
extern template class HypothesisSearch<3>;

}  // namespace cosight::ekf
