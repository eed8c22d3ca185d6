#pragma once

#include <cstdint>
#include <vector>

#include "robot_agent/ekf/chi_squared.hpp"
#include "robot_agent/ekf/joint_compatibility.hpp"
#include "robot_agent/ekf/joint_innovation.hpp"

namespace cosight::experiments {

/// How the matches of a frame are told right from wrong before they are fused.
enum class Validation {
  kNone,
  kGate,            ///< each by its own chi-squared gate, 99 %
  kHohct,           ///< the gate, then the highest-order compatible hypothesis
  kHohctThenEach,   ///< after that each pairing by its own gate, given all others: as slam does it
  kJcbb,            ///< the gate, then joint compatibility branch and bound (Neira and Tardos 2001)
  kOnePointRansac,  ///< the gate, then the consensus of one match's update (Civera 2010)
};

/// Joint compatibility branch and bound over the pairings of one innovation: of all jointly compatible sets
/// the largest, of those the one with the smallest distance. Stops after `max_nodes` with the best so far.
class BranchAndBound {
 public:
  explicit BranchAndBound(double probability = 0.95, int max_nodes = 5'000);
  /// One entry a pairing, zero: off.
  std::vector<char> test(const ekf::JointInnovation& innovation);
  /// The last test stopped before it had seen everything.
  bool was_cut() const { return nodes_ >= max_nodes_; }

 private:
  void search(std::size_t pairing, int rows, int accepted, double distance);

  ekf::ChiSquaredLimits limits_;
  int max_nodes_;
  int nodes_ = 0;
  const ekf::JointInnovation* innovation_ = nullptr;
  Eigen::MatrixXd L_;
  Eigen::VectorXd whitened_;
  std::vector<int> rows_of_state_;  ///< rows of S in the present set
  std::vector<char> keep_;
  std::vector<char> best_;
  int best_accepted_ = -1;
  double best_distance_ = 0.0;
};

/// One-point RANSAC on the linearised innovation. Each match is tried as the hypothesis (there are few): the
/// one with the most matches within `threshold_px` of what its update predicts wins; the others are rescued
/// by their gate, given the winners.
std::vector<char> one_point_ransac(const ekf::JointInnovation& innovation, double threshold_px = 3.0,
                                   double rescue_probability = 0.99);

/// Any of the ways; a pure function of the innovation.
class Validator {
 public:
  explicit Validator(Validation validation);
  std::vector<char> test(const ekf::JointInnovation& innovation);

 private:
  Validation validation_;
  ekf::JointCompatibility joint_compatibility_;
  BranchAndBound branch_and_bound_;
};

}  // namespace cosight::experiments
