#include "sim/motion/keyframes.hpp"

#include <algorithm>

namespace cosight::sim {

double value_at(const std::vector<Keyframe>& keyframes, double time) {
  if (keyframes.empty()) return 0.0;
  const auto after = std::upper_bound(keyframes.begin(), keyframes.end(), time,
                                      [](double t, const Keyframe& k) { return t < k.time; });
  if (after == keyframes.begin()) return keyframes.front().value;
  const Keyframe& from = *(after - 1);
  if (after == keyframes.end()) return from.value;
  const double x = (time - from.time) / (after->time - from.time);
  return from.value + (after->value - from.value) * x * x * x * (10.0 + x * (-15.0 + 6.0 * x));
}

}  // namespace cosight::sim
