#include "sim/sensors/ahrs.hpp"

#include <cmath>
#include <numbers>

#include "sim/sensors/wander.hpp"

namespace cosight::sim {
namespace {

Eigen::Vector3d normal3(RandomStream& random, double sigma) {
  const double x = random.normal();
  const double y = random.normal();
  return sigma * Eigen::Vector3d(x, y, random.normal());
}

Eigen::Quaterniond small_turn(const Eigen::Vector3d& angles) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(angles.z(), Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(angles.y(), Eigen::Vector3d::UnitY()) *
                            Eigen::AngleAxisd(angles.x(), Eigen::Vector3d::UnitX()));
}

}  // namespace

std::vector<AhrsSample> simulate_ahrs(const AhrsPlan& plan, const Motion& T_WH, double duration,
                                      std::uint64_t seed) {
  RandomStream noise(seed, "ahrs noise");
  const double swing_phase = RandomStream(seed, "ahrs disturbance").uniform(0.0, 2.0 * std::numbers::pi);
  Wander roll(plan.roll_pitch_sigma, plan.wander_time, RandomStream(seed, "ahrs roll"));
  Wander pitch(plan.roll_pitch_sigma, plan.wander_time, RandomStream(seed, "ahrs pitch"));
  Wander yaw(plan.yaw_sigma, plan.wander_time, RandomStream(seed, "ahrs yaw"));
  // The axes of the error are W's, turned with the heading of nobody: roll and pitch share one sigma.
  const Eigen::Vector3d sigmas(std::hypot(plan.roll_pitch_sigma, plan.white_sigma),
                               std::hypot(plan.roll_pitch_sigma, plan.white_sigma),
                               std::hypot(plan.yaw_sigma, plan.white_sigma));
  std::vector<AhrsSample> samples;
  double last = 0.0;
  for (const Tick& tick : ticks(plan.timing, duration, RandomStream(seed, "ahrs clock"))) {
    const double step = tick.time - last;
    last = tick.time;
    const double swing =
        plan.disturbance * std::sin(2.0 * std::numbers::pi * tick.time / plan.disturbance_time + swing_phase);
    const Eigen::Vector3d error = Eigen::Vector3d(roll.advance(step), pitch.advance(step),
                                                  yaw.advance(step) + plan.north_offset + swing) +
                                  normal3(noise, plan.white_sigma);
    const InertialTruth truth = feel(T_WH, tick.time);
    AhrsSample sample;
    sample.stamp = tick.stamp;
    sample.q_WH = (small_turn(error) * T_WH(tick.time).q).normalized();
    sample.orientation_covariance = sigmas.cwiseAbs2().asDiagonal();
    sample.angular_velocity_H = truth.angular_velocity + normal3(noise, plan.gyro_sigma);
    sample.acceleration_H = truth.specific_force + normal3(noise, plan.acceleration_sigma);
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace cosight::sim
