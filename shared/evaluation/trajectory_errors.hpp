#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shared/evaluation/alignment.hpp"
#include "shared/evaluation/error_statistics.hpp"

namespace cosight {

/// The pairs with the estimate laid onto the truth.
std::vector<PosePair> aligned(std::vector<PosePair> pairs, const Similarity& similarity);

/// Distance of each estimated position from the true one [m].
std::vector<double> position_errors(const std::vector<PosePair>& pairs);

/// Angle of each R_truth^T R_estimate [rad].
std::vector<double> rotation_errors(const std::vector<PosePair>& pairs);

/// Length of the true path through the pairs [m]; that of the estimate.
double true_path_length(const std::vector<PosePair>& pairs);
double estimated_path_length(const std::vector<PosePair>& pairs);

/// Unit of the step over which the relative pose error is taken.
enum class DeltaUnit { kFrames, kMetres, kSeconds };
std::optional<DeltaUnit> delta_unit_from(const std::string& name);

struct RelativeErrorOptions {
  double delta = 1.0;  ///< [frames, m or s]
  DeltaUnit unit = DeltaUnit::kFrames;
  bool all_pairs = false;  ///< frames only: every start, not only each delta-th
};

/// Relative pose errors as the evo toolkit defines them: with Q the true and P the estimated poses,
///
///   E_ij = (Q_i^-1 Q_j)^-1 (P_i^-1 P_j),   |trans(E_ij)| [m],   angle(E_ij) [rad].
///
/// Frames: consecutive intervals of `delta`. Metres and seconds: each interval ends at the first pose at
/// least `delta` after its start, along the true path (evo's pairs_from_reference).
struct RelativeErrors {
  std::vector<double> translation;
  std::vector<double> rotation;
};
RelativeErrors relative_errors(const std::vector<PosePair>& pairs, const RelativeErrorOptions& options);

}  // namespace cosight
