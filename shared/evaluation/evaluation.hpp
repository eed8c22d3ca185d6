#pragma once

#include <optional>
#include <string>
#include <vector>

#include "shared/evaluation/consistency.hpp"
#include "shared/evaluation/frame_log.hpp"
#include "shared/evaluation/trajectory_errors.hpp"

namespace cosight {

struct EvaluationOptions {
  Alignment alignment = Alignment::kNone;
  Stamp max_difference = 10'000'000;  ///< farthest truth in time that an estimate is compared with [ns]
  Stamp truth_offset = 0;  ///< added to the truth's stamps [ns]; for a truth with a clock of its own
  RelativeErrorOptions relative;
};

/// One figure; the name ends in its unit. Without a value where it is not defined ("n/a").
struct Metric {
  std::string name;
  std::optional<double> value;
};

/// A run against its truth.
struct Evaluation {
  std::vector<PosePair> pairs;          ///< aligned
  std::vector<double> position_errors;  ///< [m], one a pair
  std::vector<double> rotation_errors;  ///< [rad], one a pair
  Similarity T_truth_estimate;          ///< the alignment used
  std::vector<Metric> metrics;

  std::optional<double> metric(const std::string& name) const;
};

/// Every metric of the trajectory, and those of the frames and covariances where they are not empty. Throws
/// EvaluationError when no stamps match, or the alignment is not determined by the positions.
Evaluation evaluate(const Trajectory& estimate, const Trajectory& truth, const EvaluationOptions& options,
                    const std::vector<FrameRecord>& frames = {}, const CovarianceLog& covariances = {});

}  // namespace cosight
