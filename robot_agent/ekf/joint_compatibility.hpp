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
};

/// Which pairings hold together.
struct Hypothesis {
  std::vector<char> keep;  ///< one entry a measurement of the innovation, zero: off
  int removed = 0;
  int rows = 0;           ///< of the kept ones
  double distance = 0.0;  ///< g^T S^-1 g of the kept ones
  double limit = 0.0;     ///< chi-squared limit for `rows`
  bool exact = true;      ///< false: more than `exact_removals` had to go and the rest was chosen greedily
};

/// Highest-order hypothesis compatibility test (HOHCT): all pairings on, then every hypothesis with one off,
/// with two off, ... The first order at which any is compatible wins, by the smallest distance (in parts of
/// its limit, as pairings may have two rows or three). When S cannot be inverted, all pairings are off.
class JointCompatibility {
 public:
  explicit JointCompatibility(const JointCompatibilityOptions& options = {});

  /// The result is valid until the next call.
  const Hypothesis& test(const JointInnovation& innovation);

 private:
  bool factorise(const JointInnovation& innovation);
  void invert();
  template <int Block>
  void search(HypothesisSearch<Block>& search);
  template <int Block>
  void take_off(HypothesisSearch<Block>& search, std::span<const int> pairings);

  JointCompatibilityOptions options_;
  ChiSquaredLimits limits_;
  std::vector<int> pairing_rows_;
  Eigen::MatrixXd L_;
  Eigen::MatrixXd L_inverse_;
  Eigen::MatrixXd A_;
  Eigen::VectorXd whitened_;
  Eigen::VectorXd u_;
  HypothesisSearch<2> pixels_;
  HypothesisSearch<3> mixed_;
  Hypothesis hypothesis_;
};

}  // namespace cosight::ekf
