#pragma once

#include <algorithm>
#include <array>
#include <cstdint>

#include "shared/dataset/stamp.hpp"

namespace cosight::recording {

/// How late messages were, in steps of 20 us up to 200 ms.
class Lateness {
 public:
  void add(Stamp late) {
    const Stamp step = std::clamp<Stamp>(late / kStep, 0, kSteps - 1);
    ++counts_[static_cast<std::size_t>(step)];
    ++total_;
    worst_ = std::max(worst_, late);
  }
  /// That share [0, 1] of the messages were no later [ns].
  Stamp quantile(double share) const {
    const auto wanted = static_cast<std::uint64_t>(share * static_cast<double>(total_));
    std::uint64_t sum = 0;
    for (std::size_t i = 0; i < counts_.size(); ++i) {
      sum += counts_[i];
      if (sum >= wanted && sum > 0) return std::min(worst_, static_cast<Stamp>(i + 1) * kStep);
    }
    return worst_;
  }
  Stamp worst() const { return worst_; }

 private:
  static constexpr Stamp kStep = 20'000;
  static constexpr Stamp kSteps = 10'000;
  std::array<std::uint64_t, kSteps> counts_{};
  std::uint64_t total_ = 0;
  Stamp worst_ = 0;
};

}  // namespace cosight::recording
