#pragma once

#include <optional>

#include "shared/dataset/stamp.hpp"

namespace cosight::inbox {

/// From the stamps of a stream to its arrivals, a slow mean. The two are of different clocks: only the
/// difference between two streams means something.
class ArrivalDelay {
 public:
  void note(Stamp delay) { mean_ = mean_ ? *mean_ + (delay - *mean_) / kMemory : delay; }
  std::optional<Stamp> mean() const { return mean_; }

 private:
  static constexpr Stamp kMemory = 16;  ///< samples
  std::optional<Stamp> mean_;
};

}  // namespace cosight::inbox
