#pragma once

#include <cstdint>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "sim/random.hpp"

namespace cosight::sim {

/// When a sensor measures, and what time its clock says then.
struct TimingPlan {
  double rate = 100.0;        ///< [Hz]
  double latency = 0.0;       ///< the stamp is this much late: it is given when the data arrives [s]
  double jitter = 0.0;        ///< standard deviation of the latency, never earlier than the measurement [s]
  double drop_out = 0.0;      ///< share of measurements that never arrive
  double clock_offset = 0.0;  ///< of the machine's clock [s]
  double clock_drift = 0.0;   ///< of the machine's clock [s/s]
};

/// One measurement: the time at which it was really made, and the stamp on it.
struct Tick {
  double time = 0.0;  ///< since the start [s]
  Stamp stamp = 0;
};

/// All that arrive from 0 to `duration`, stamps strictly increasing.
std::vector<Tick> ticks(const TimingPlan& plan, double duration, RandomStream random);

/// The stamp of the true time 0: any day will do.
constexpr Stamp kStartStamp = 1'000 * kNanosecondsPerSecond;

/// The stamp that a perfect clock gives.
Stamp true_stamp(double time);

}  // namespace cosight::sim
