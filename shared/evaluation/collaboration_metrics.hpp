#pragma once

#include <optional>
#include <vector>

#include "shared/evaluation/association.hpp"
#include "shared/evaluation/frame_log.hpp"

namespace cosight {

/// How long the worn camera gave measurements, which is the paper's overlap time (C section 5.4), and how
/// long it did not, period by period [s]. Gaps of a third of a second are none.
struct OverlapPeriods {
  std::vector<double> overlaps;  ///< eta_i
  std::vector<double> gaps;      ///< mu_j

  double total_overlap() const;
  double total_time() const;
};

/// A frame lasts until the next one; the last one as long as the one before it.
OverlapPeriods overlap_periods(const std::vector<FrameRecord>& frames);

/// Overlap time over total time; nothing for less than two frames.
std::optional<double> overlap_ratio(const OverlapPeriods& periods);

/// tau = N sum_i |eta_i - eta_total / N|, as printed in C17 [s]. Zero when all periods last equally long;
/// nothing for less than two of them.
std::optional<double> overlap_irregularity(const OverlapPeriods& periods);

/// kappa = 1/M sum_j (mu_j - mean(mu))^2 (C18) [s^2]; nothing for less than two gaps.
std::optional<double> gap_deviation(const OverlapPeriods& periods);

/// U = eta_total / |r_k - r_1| * sum_i |r_i - r_hat_i|^2 (C19) [m s]: what the overlap cost against what it
/// gave. Nothing where the truth ends where it began.
std::optional<double> overlap_cost(const OverlapPeriods& periods, const std::vector<PosePair>& aligned_pairs);

}  // namespace cosight
