#include "sim/sensors/sensor_clock.hpp"

#include <cmath>

namespace cosight::sim {

Stamp true_stamp(double time) {
  return kStartStamp + from_seconds(time);
}

std::vector<Tick> ticks(const TimingPlan& plan, double duration, RandomStream random) {
  std::vector<Tick> all;
  for (int k = 0; k / plan.rate <= duration + 1e-9; ++k) {
    const double time = k / plan.rate;
    const double late = plan.latency + plan.jitter * std::abs(random.normal());
    const bool lost = random.chance(plan.drop_out);
    const double shown = time + late + plan.clock_offset + plan.clock_drift * time;
    const Stamp stamp = true_stamp(shown);
    if (lost || (!all.empty() && stamp <= all.back().stamp)) continue;
    all.push_back({time, stamp});
  }
  return all;
}

}  // namespace cosight::sim
