#include "robot_agent/outbox/duration_histogram.hpp"

#include <algorithm>
#include <cmath>

namespace cosight::outbox {

void DurationHistogram::add(double milliseconds) {
  if (!std::isfinite(milliseconds)) return;
  const double place = std::log(std::max(milliseconds, kLeast) / kLeast) / std::log(kRatio);
  ++bins_.at(std::min(static_cast<std::size_t>(place), kBins - 1));
  ++count_;
  sum_ += milliseconds;
  max_ = std::max(max_, milliseconds);
}

double DurationHistogram::quantile(double q) const {
  if (count_ == 0) return 0.0;
  const auto rank =
      static_cast<std::uint64_t>(std::ceil(std::clamp(q, 0.0, 1.0) * static_cast<double>(count_)));
  std::uint64_t below = 0;
  for (std::size_t i = 0; i < kBins; ++i) {
    below += bins_.at(i);
    // The middle of the bin, in the sense of ratios.
    if (below >= std::max<std::uint64_t>(rank, 1)) {
      return std::min(kLeast * std::pow(kRatio, static_cast<double>(i) + 0.5), max_);
    }
  }
  return max_;
}

}  // namespace cosight::outbox
