#include "shared/evaluation/association.hpp"

#include <cstdlib>

namespace cosight {

double path_length(const Trajectory& trajectory) {
  double length = 0.0;
  for (std::size_t i = 1; i < trajectory.size(); ++i) {
    length += (trajectory[i].T_WC.p - trajectory[i - 1].T_WC.p).norm();
  }
  return length;
}

std::vector<PosePair> associate(const Trajectory& estimate, const Trajectory& truth, Stamp max_difference,
                                Stamp truth_offset) {
  std::vector<PosePair> pairs;
  if (truth.empty()) return pairs;
  const auto distance = [&](std::size_t i, const StampedPose& pose) {
    return std::abs(truth[i].stamp + truth_offset - pose.stamp);
  };
  std::size_t nearest = 0;  // both lists are sorted, so it only moves forward
  std::size_t last_used = truth.size();
  for (const StampedPose& pose : estimate) {
    while (nearest + 1 < truth.size() && distance(nearest + 1, pose) <= distance(nearest, pose))
      ++nearest;
    if (distance(nearest, pose) > max_difference) continue;
    const PosePair pair{pose.stamp, pose.T_WC, truth[nearest].T_WC};
    if (nearest != last_used) {
      pairs.push_back(pair);
    } else if (distance(nearest, pose) < std::abs(truth[nearest].stamp + truth_offset - pairs.back().stamp)) {
      pairs.back() = pair;
    }
    last_used = nearest;
  }
  return pairs;
}

}  // namespace cosight
