#include "shared/evaluation/collaboration_metrics.hpp"

#include <cmath>
#include <numeric>
#include <optional>

namespace cosight {
namespace {

constexpr double kMinDistance = 1e-6;  // [m]

double sum(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0);
}

double duration(const std::vector<FrameRecord>& frames, std::size_t i) {
  const std::size_t from = i + 1 < frames.size() ? i : i - 1;
  return to_seconds(frames[from + 1].stamp - frames[from].stamp);
}

/// Whether each frame lies in an overlap: a frame or two without a match between others with one are no gap.
std::vector<bool> with_blinks_closed(const std::vector<FrameRecord>& frames) {
  constexpr Stamp kBlink = 350'000'000;  // [ns]
  std::vector<bool> overlap(frames.size());
  std::optional<std::size_t> last;
  for (std::size_t i = 0; i < frames.size(); ++i) {
    if (!frames[i].pseudo_stereo) continue;
    const bool blinked = last && frames[i].stamp - frames[*last].stamp <= kBlink;
    for (std::size_t k = blinked ? *last : i; k <= i; ++k)
      overlap[k] = true;
    last = i;
  }
  return overlap;
}

}  // namespace

double OverlapPeriods::total_overlap() const {
  return sum(overlaps);
}
double OverlapPeriods::total_time() const {
  return sum(overlaps) + sum(gaps);
}

OverlapPeriods overlap_periods(const std::vector<FrameRecord>& frames) {
  OverlapPeriods periods;
  if (frames.size() < 2) return periods;
  const std::vector<bool> overlap = with_blinks_closed(frames);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    std::vector<double>& kind = overlap[i] ? periods.overlaps : periods.gaps;
    if (i == 0 || overlap[i] != overlap[i - 1]) kind.push_back(0.0);
    kind.back() += duration(frames, i);
  }
  return periods;
}

std::optional<double> overlap_ratio(const OverlapPeriods& periods) {
  if (periods.total_time() <= 0.0) return std::nullopt;
  return periods.total_overlap() / periods.total_time();
}

std::optional<double> overlap_irregularity(const OverlapPeriods& periods) {
  if (periods.overlaps.size() < 2) return std::nullopt;
  const double N = static_cast<double>(periods.overlaps.size());
  const double mean = periods.total_overlap() / N;
  double deviation = 0.0;
  for (const double eta : periods.overlaps)
    deviation += std::abs(eta - mean);
  return N * deviation;
}

std::optional<double> gap_deviation(const OverlapPeriods& periods) {
  if (periods.gaps.size() < 2) return std::nullopt;
  const double M = static_cast<double>(periods.gaps.size());
  const double mean = sum(periods.gaps) / M;
  double squares = 0.0;
  for (const double mu : periods.gaps)
    squares += (mu - mean) * (mu - mean);
  return squares / M;
}

std::optional<double> overlap_cost(const OverlapPeriods& periods,
                                   const std::vector<PosePair>& aligned_pairs) {
  if (aligned_pairs.empty()) return std::nullopt;
  const double distance = (aligned_pairs.back().T_WC_truth.p - aligned_pairs.front().T_WC_truth.p).norm();
  if (distance < kMinDistance) return std::nullopt;
  double squares = 0.0;
  for (const PosePair& pair : aligned_pairs)
    squares += (pair.T_WC_truth.p - pair.T_WC_estimate.p).squaredNorm();
  return periods.total_overlap() / distance * squares;
}

}  // namespace cosight
