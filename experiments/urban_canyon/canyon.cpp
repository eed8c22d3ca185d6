#include "experiments/urban_canyon/canyon.hpp"

#include <cmath>

#include "experiments/urban_canyon/gaussian.hpp"

namespace cosight::experiments {
namespace {

using Eigen::Vector3d;

constexpr double kImuRate = 200.0;   // [Hz]
constexpr double kFrameRate = 10.0;  // [Hz]
constexpr double kGravity = 9.7876;  // as in Hong Kong [m/s^2]
constexpr Stamp kStart = 1'000'000'000'000;

/// What the IMU measures: the route's own derivatives, biases that walk, white noise.
std::vector<vins::ImuSample> measure_imu(const Route& route, const CanyonOptions& options,
                                         std::mt19937_64& random) {
  const double root_rate = std::sqrt(kImuRate);
  Vector3d accelerometer_bias = gaussian<3>(random, options.start_accelerometer_bias);
  Vector3d gyroscope_bias = gaussian<3>(random, options.start_gyroscope_bias);
  std::vector<vins::ImuSample> samples;
  for (int i = 0; i / kImuRate < route.duration() + 1.0; ++i) {
    const double t = i / kImuRate;
    vins::ImuSample sample;
    sample.stamp = kStart + from_seconds(t);
    const Vector3d force_W = route.acceleration_W(t) + Vector3d(0.0, 0.0, kGravity);
    sample.acceleration_B = route.T_WB(t).q.conjugate() * force_W + accelerometer_bias +
                            gaussian<3>(random, options.imu.accelerometer * root_rate);
    sample.angular_velocity_B =
        route.body_rate(t) + gyroscope_bias + gaussian<3>(random, options.imu.gyroscope * root_rate);
    accelerometer_bias += gaussian<3>(random, options.imu.accelerometer_walk / root_rate);
    gyroscope_bias += gaussian<3>(random, options.imu.gyroscope_walk / root_rate);
    samples.push_back(sample);
  }
  return samples;
}

}  // namespace

CanyonOptions urban_canyon_1() {
  CanyonOptions options;
  options.calibrated_noise = options.front_end.noise = 0.1;
  options.traffic = {.ahead_share = 0.75,
                     .neighbours_per_minute = 1.0,
                     .oncoming_per_minute = 5.0,
                     .turning_per_minute = 1.5,
                     .crossing_per_corner = 1.5,
                     .texture = 1.5};
  options.front_end.loss = 0.0002;
  return options;
}

CanyonOptions urban_canyon_2() {
  CanyonOptions options;
  options.length = 1980.0;
  options.traffic = {.ahead_share = 0.9,
                     .neighbours_per_minute = 4.0,
                     .oncoming_per_minute = 16.0,
                     .turning_per_minute = 3.0,
                     .crossing_per_corner = 3.0,
                     .texture = 2.5};
  options.calibrated_noise = options.front_end.noise = 0.19;
  options.front_end.noise_spread = 1.5;
  options.front_end.loss = 0.0003;
  options.front_end.slip = 0.0005;
  return options;
}

CanyonDrive make_canyon_drive(const CanyonOptions& options, unsigned seed) {
  std::mt19937_64 random(seed);
  const Route route(options.length, random);
  const std::vector<StreetPoint> street = make_street(route, random);
  const std::vector<Vehicle> traffic = make_traffic(route, options.traffic, random);
  CanyonDrive drive;
  drive.sequence.T_BS = CityView::T_BS();
  drive.sequence.gravity = kGravity;
  drive.sequence.imu = measure_imu(route, options, random);
  CityView view(route, street, traffic);
  FrontEnd front_end(options.front_end, random);
  for (int k = 0; k / kFrameRate < route.duration(); ++k) {
    const double t = 0.02 + k / kFrameRate;
    const Stamp stamp = kStart + from_seconds(t);
    view.go_to(t);
    drive.sequence.frames.push_back({stamp, front_end.look(view)});
    drive.sequence.truth.push_back({stamp, route.T_WB(t)});
    drive.velocities_W.push_back(route.velocity_W(t));
  }
  drive.moving_percent = front_end.moving_percent();
  drive.moving = front_end.moving();
  return drive;
}

vins::TrackSequence without_vehicles(const CanyonDrive& drive) {
  vins::TrackSequence sequence = drive.sequence;
  for (vins::FeatureFrame& frame : sequence.frames) {
    std::erase_if(frame.features, [&](const auto& feature) { return drive.moving.contains(feature.id); });
  }
  return sequence;
}

}  // namespace cosight::experiments
