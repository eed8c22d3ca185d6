#include "sim/sensors/imu.hpp"

#include <array>
#include <cmath>

#include "sim/sensors/wander.hpp"

namespace cosight::sim {
namespace {

/// Three axes of noise: a bias from the start on, its wandering, and white noise.
class Triad {
 public:
  Triad(double start, double wander, double wander_time, double white, std::uint64_t seed,
        std::string_view purpose)
      : white_(white),
        random_(seed, purpose),
        wander_{Wander(wander, wander_time, RandomStream(random_.bits(), "x")),
                Wander(wander, wander_time, RandomStream(random_.bits(), "y")),
                Wander(wander, wander_time, RandomStream(random_.bits(), "z"))},
        start_(start * normal3()) {}

  Eigen::Vector3d bias(double step) {
    const double x = wander_[0].advance(step);
    const double y = wander_[1].advance(step);
    return start_ + Eigen::Vector3d(x, y, wander_[2].advance(step));
  }
  Eigen::Vector3d white() { return white_ * normal3(); }

 private:
  Eigen::Vector3d normal3() {
    const double x = random_.normal();
    const double y = random_.normal();
    return {x, y, random_.normal()};
  }

  double white_;
  RandomStream random_;
  std::array<Wander, 3> wander_;
  Eigen::Vector3d start_;
};

}  // namespace

std::vector<BiasedImuSample> simulate_imu(const ImuPlan& plan, const Motion& T_WB, double duration,
                                          std::uint64_t seed) {
  const double per_sample = std::sqrt(plan.timing.rate);  // a density's deviation in one sample
  Triad gyro(plan.gyro_bias, plan.gyro_bias_wander, plan.wander_time, plan.gyro_density * per_sample, seed,
             "gyro");
  Triad acceleration(plan.acceleration_bias, plan.acceleration_bias_wander, plan.wander_time,
                     plan.acceleration_density * per_sample, seed, "accelerometer");
  const Motion T_WI = [&](double time) { return T_WB(time) * plan.T_BI; };
  std::vector<BiasedImuSample> samples;
  double last = 0.0;
  for (const Tick& tick : ticks(plan.timing, duration, RandomStream(seed, "imu clock"))) {
    const InertialTruth truth = feel(T_WI, tick.time);
    const double step = tick.time - last;
    last = tick.time;
    BiasedImuSample sample{{.stamp = tick.stamp}, gyro.bias(step), acceleration.bias(step)};
    sample.measured.angular_velocity_I = truth.angular_velocity + sample.gyro_bias + gyro.white();
    sample.measured.acceleration_I = truth.specific_force + sample.acceleration_bias + acceleration.white();
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace cosight::sim
