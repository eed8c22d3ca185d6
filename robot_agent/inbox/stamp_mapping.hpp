#pragma once

#include <atomic>

#include "shared/dataset/stamp.hpp"

namespace cosight::inbox {

/// The one place through which every stamp passes on its way in: what leaves is on the robot's clock.
class StampMapping {
 public:
  Stamp from_robot(Stamp stamp) const { return stamp; }
  Stamp from_wearer(Stamp stamp) const { return stamp + wearer_offset_.load(std::memory_order_relaxed); }

  /// Robot's clock minus wearer's [ns]; any thread.
  Stamp wearer_offset() const { return wearer_offset_.load(std::memory_order_relaxed); }
  void set_wearer_offset(Stamp offset) { wearer_offset_.store(offset, std::memory_order_relaxed); }

 private:
  std::atomic<Stamp> wearer_offset_ = 0;
};

}  // namespace cosight::inbox
