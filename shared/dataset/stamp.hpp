#pragma once

#include <cstdint>

namespace cosight {

/// Time since the epoch of whichever clock made it [ns]. Nothing in the core asks what time it is: time is in
/// the samples.
using Stamp = std::int64_t;

constexpr Stamp kNanosecondsPerSecond = 1'000'000'000;

constexpr double to_seconds(Stamp duration) {
  return static_cast<double>(duration) / static_cast<double>(kNanosecondsPerSecond);
}
constexpr Stamp from_seconds(double seconds) {
  return static_cast<Stamp>(seconds * static_cast<double>(kNanosecondsPerSecond) +
                            (seconds < 0 ? -0.5 : 0.5));
}

}  // namespace cosight
