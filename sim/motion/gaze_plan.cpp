#include "sim/motion/gaze_plan.hpp"

#include <algorithm>
#include <iterator>
#include <numeric>

#include "sim/random.hpp"

namespace cosight::sim {

std::vector<Keyframe> glances(const GazePlan& plan, double share, double duration, std::uint64_t seed) {
  RandomStream random(seed, "glances");
  std::vector<double> pauses;
  std::generate_n(std::back_inserter(pauses), plan.intervals, [&] { return random.uniform(0.5, 1.5); });
  const double pause_sum = std::accumulate(pauses.begin(), pauses.end(), 0.0);
  const double look = share * duration / plan.intervals;
  double side = random.chance(0.5) ? 1.0 : -1.0;
  std::vector<Keyframe> keyframes;
  double time = 0.0;
  for (const double weight : pauses) {
    const double pause = (1.0 - share) * duration * weight / pause_sum;
    // Both turns are in the pause; a pause too short for them is a short turn there and back.
    const double turn = std::min(plan.turn_time, 0.45 * pause);
    time += look;
    if (pause > 1e-3) {
      keyframes.push_back({time, 0.0});
      keyframes.push_back({time + turn, side * plan.aside});
      keyframes.push_back({time + pause - turn, side * plan.aside});
      keyframes.push_back({time + pause, 0.0});
    }
    time += pause;
    side = -side;
  }
  return keyframes;
}

}  // namespace cosight::sim
