#include "sim/sensors/laser.hpp"

#include <cmath>
#include <limits>

namespace cosight::sim {

std::vector<double> exact_ranges(const LaserPlan& plan, const Pose& T_WB, std::span<const Quad> quads) {
  const Pose T_WL = T_WB * plan.T_BL;
  std::vector<double> ranges;
  for (int point = 0; point < plan.points; ++point) {
    const double angle = plan.angle_of(point);
    const Eigen::Vector3d direction = T_WL.q * Eigen::Vector3d(std::cos(angle), std::sin(angle), 0.0);
    const std::optional<Hit> hit = cast_ray(quads, T_WL.p, direction);
    ranges.push_back(hit ? hit->range : 0.0);
  }
  return ranges;
}

std::vector<LaserScan> simulate_laser(const LaserPlan& plan, const Motion& T_WB, const Surroundings& quads_at,
                                      double duration, std::uint64_t seed) {
  RandomStream random(seed, "laser noise");
  std::vector<LaserScan> scans;
  for (const Tick& tick : ticks(plan.timing, duration, RandomStream(seed, "laser clock"))) {
    LaserScan scan{tick.stamp, {}};
    for (const double exact : exact_ranges(plan, T_WB(tick.time), quads_at(tick.time))) {
      const double measured = exact + plan.bias + plan.sigma * random.normal();
      const bool returned = exact > 0.0 && !random.chance(plan.miss) && measured >= plan.range_min &&
                            measured <= plan.range_max;
      scan.ranges.push_back(returned ? static_cast<float>(measured) : std::numeric_limits<float>::infinity());
    }
    scans.push_back(std::move(scan));
  }
  return scans;
}

}  // namespace cosight::sim
