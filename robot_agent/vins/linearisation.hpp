#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_agent/vins/factor_graph.hpp"

namespace cosight::vins {

/// H dx = -b: the normal equations of |r + J dx|^2 at some point, H = J^T J, b = J^T r.
struct NormalEquations {
  Eigen::MatrixXd H;
  Eigen::VectorXd b;
};

/// Where each state stands in the normal equations: some first, then the others.
class StateLayout {
 public:
  StateLayout(std::vector<StateKey> keys, const std::vector<StateKey>& first);

  /// First column of a state, or -1 when it has none: a constant.
  Eigen::Index column(StateKey key) const;
  Eigen::Index size() const { return size_; }
  Eigen::Index first_size() const { return first_size_; }
  std::vector<StateKey> rest() const;

 private:
  struct Place {
    StateKey key;
    Eigen::Index column;
  };
  std::vector<Place> places_;
  Eigen::Index size_ = 0;
  Eigen::Index first_size_ = 0;
};

/// All factors of a graph at its present parameters; the landmarks are taken out at once, one by
/// one. A kernel weighs its residual by sqrt(rho'), which keeps H positive semidefinite.
NormalEquations linearise(FactorGraph& graph, const StateLayout& layout);

}  // namespace cosight::vins
