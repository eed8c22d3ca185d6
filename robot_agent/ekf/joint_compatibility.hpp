#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_agent/ekf/chi_squared.hpp"
#include "robot_agent/ekf/hypothesis_search.hpp"
#include "robot_agent/ekf/joint_innovation.hpp"

namespace cosight::ekf {

struct JointCompatibilityOptions {
  double probability = 0.95;  ///< a right set of pairings passes with it
  int exact_removals = 3;     ///< all hypotheses with so many pairings off are tried, then one goes at a time
  /// A right pairing passes its own gate, given all other kept ones, with it; 1 switches that off. A joint
  /// distance of many good pairings has slack for a bad one, which this takes away.
  double each_probability = 0.99;
};

/// Which pairings hold together.
struct Hypothesis {
  std::vector<char> keep;  ///< one entry a measurement of the innovation, zero: off
  int removed = 0;
  int improbable =
      0;         ///< of the removed, those that the rest was compatible with, but they not with the rest
  int rows = 0;  ///< of the kept ones
  double distance = 0.0;  ///< g^T S^-1 g of the kept ones
  double limit = 0.0;     ///< chi-squared limit for `rows`
  bool exact = true;      ///< false: more than `exact_removals` had to go and the rest was chosen greedily
};

/// Highest-order hypothesis compatibility test (HOHCT): all pairings on, then every hypothesis with one off,
/// with two off, ... The first order at which any is compatible wins, by the smallest distance (in parts of
/// its limit, as pairings may have two rows or three). When S cannot be inverted, all pairings are off.
///
/// Then each kept pairing is held against all others. Given these its innovation is A_kk^-1 u_k with
/// covariance A_kk^-1, where A = S^-1 and u = A g; so
///
///   d_k^2 = u_k^T A_kk^-1 u_k
///
/// is chi-squared with the pairing's rows. The worst one outside its gate goes, and so on until none is.
class JointCompatibility {
 public:
  explicit JointCompatibility(const JointCompatibilityOptions& options = {});

  /// The result is valid until the next call.
  const Hypothesis& test(const JointInnovation& innovation);

 private:
  void make_room(int rows);
  bool factorise(const JointInnovation& innovation);
  void invert_factor();
  bool each_is_probable() const;
  template <int Block>
  void select(HypothesisSearch<Block>& search);
  template <int Block>
  void find_compatible(HypothesisSearch<Block>& search);
  template <int Block>
  void drop_improbable(HypothesisSearch<Block>& search);
  template <int Block>
  void take_off(HypothesisSearch<Block>& search, std::span<const int> pairings);

  JointCompatibilityOptions options_;
  ChiSquaredLimits limits_;
  ChiSquaredLimits each_limits_;
  std::vector<int> pairing_rows_;
  int rows_ = 0;  ///< of the present innovation; the storage has room for more
  Eigen::MatrixXd L_storage_;
  Eigen::MatrixXd L_inverse_storage_;
  Eigen::MatrixXd A_storage_;         ///< S^-1
  Eigen::VectorXd whitened_storage_;  ///< L^-1 g
  Eigen::VectorXd u_storage_;         ///< S^-1 g
  HypothesisSearch<2> pixels_;
  HypothesisSearch<3> mixed_;
  Hypothesis hypothesis_;
};

}  // namespace cosight::ekf
