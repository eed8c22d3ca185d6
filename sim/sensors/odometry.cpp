#include "sim/sensors/odometry.hpp"

#include <cmath>
#include <numbers>

namespace cosight::sim {
namespace {

double yaw_of(const Pose& T_WB) {
  const Eigen::Vector3d forward = T_WB.q * Eigen::Vector3d::UnitX();
  return std::atan2(forward.y(), forward.x());
}

}  // namespace

std::vector<WheelOdometrySample> simulate_odometry(const OdometryPlan& plan, const Motion& T_WB,
                                                   double duration, std::uint64_t seed) {
  RandomStream random(seed, "odometry noise");
  const double scale = 1.0 + plan.scale_sigma * random.normal();
  const double turn_scale = 1.0 + plan.turn_scale_sigma * random.normal();
  std::vector<WheelOdometrySample> rows;
  Pose last = T_WB(0.0);
  double last_time = 0.0;
  WheelOdometrySample row;
  for (const Tick& tick : ticks(plan.timing, duration, RandomStream(seed, "odometry clock"))) {
    const Pose now = T_WB(tick.time);
    const double middle =
        yaw_of(last) + 0.5 * std::remainder(yaw_of(now) - yaw_of(last), 2.0 * std::numbers::pi);
    const double way = (now.p - last.p).dot(Eigen::Vector3d(std::cos(middle), std::sin(middle), 0.0));
    const double turn = std::remainder(yaw_of(now) - yaw_of(last), 2.0 * std::numbers::pi);
    const double root = std::sqrt(std::abs(way));
    const double measured_way = scale * way + plan.slip * root * random.normal();
    const double measured_turn = turn_scale * turn + plan.turn_slip * root * random.normal();
    const double direction = row.yaw + 0.5 * measured_turn;
    const double step = tick.time - last_time;
    row = {tick.stamp,
           row.x + measured_way * std::cos(direction),
           row.y + measured_way * std::sin(direction),
           row.yaw + measured_turn,
           step > 0.0 ? measured_way / step : 0.0,
           step > 0.0 ? measured_turn / step : 0.0};
    rows.push_back(row);
    last = now;
    last_time = tick.time;
  }
  return rows;
}

}  // namespace cosight::sim
