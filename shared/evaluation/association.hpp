#pragma once

#include <vector>

#include "shared/evaluation/trajectory.hpp"

namespace cosight {

/// One time at which both the estimate and the truth are known.
struct PosePair {
  Stamp stamp = 0;  ///< the estimate's
  Pose T_WC_estimate;
  Pose T_WC_truth;
};

/// Pairs each estimated pose with the true one nearest in time, at most `max_difference` [ns] away; each true
/// pose is used at most once. `truth_offset` [ns] is added to the truth's stamps first.
std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& truth, Stamp max_difference,
                                Stamp truth_offset = 0);

}  // namespace cosight
