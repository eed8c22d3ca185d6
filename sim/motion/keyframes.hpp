#pragma once

#include <vector>

namespace cosight::sim {

/// A value that rests at its keyframes' values and glides between them.
struct Keyframe {
  double time = 0.0;  ///< [s] since the start
  double value = 0.0;
};

/// Quintic glide (no step in the second derivative) between neighbouring keyframes; constant before the first
/// and after the last; 0 without any. Times must not decrease.
double value_at(const std::vector<Keyframe>& keyframes, double time);

}  // namespace cosight::sim
