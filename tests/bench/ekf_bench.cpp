// The filter's parts at the size of the target: 100 landmarks (n = 613), 40 of them measured as pixels.
#include <benchmark/benchmark.h>

#include <Eigen/Cholesky>
#include <random>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/ekf/joint_compatibility.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

/// A filter full of landmarks ahead of the camera, and measurements of some of them.
struct Scene {
  explicit Scene(int landmarks, int measured) : filter(camera, options(landmarks)) {
    UncertainPose T_WS;
    T_WS.T.q = Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5);  // looks along x
    T_WS.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    filter.reset(T_WS, 0.3, 0.3);
    StereoRig rig{camera, camera, {}, 1.0, 1.0};
    rig.T_SF.T.p = {0.5, 0.0, 0.0};
    rig.T_SF.covariance.diagonal() << 1e-4, 1e-4, 1e-4, 1e-5, 1e-5, 1e-5;
    std::mt19937 rng(1);
    std::uniform_real_distribution<double> side(-0.6, 0.6);
    std::uniform_real_distribution<double> depth(2.0, 8.0);
    std::vector<StereoMatch> matches;
    for (int i = 0; i < landmarks; ++i) {
      const Eigen::Vector3d p_S = depth(rng) * Eigen::Vector3d(side(rng), 0.6 * side(rng), 1.0);
      matches.push_back({*camera.project(p_S), *camera.project(rig.T_SF.T.inverse() * p_S)});
    }
    filter.add_pseudo_stereo_landmarks(matches, rig);
    filter.predict(0.033);
    std::normal_distribution<double> noise(0.0, 1.0);
    for (int i = 0; i < measured; ++i) {
      const auto p = filter.predict_pixel(filter.landmark_id(i * landmarks / measured));
      measurements.push_back(
          Measurement::pixel(p->landmark, p->pixel + Eigen::Vector2d(noise(rng), noise(rng)), 1.0));
    }
  }
  static FilterOptions options(int landmarks) {
    FilterOptions o;
    o.max_landmarks = landmarks;
    return o;
  }

  CameraModel camera{.fx = 458.0, .fy = 457.0, .cx = 367.0, .cy = 248.0, .width = 752, .height = 480};
  Filter filter;
  std::vector<Measurement> measurements;
};

void count_flops(benchmark::State& state, double flops) {
  state.counters["GFLOP/s"] = benchmark::Counter(flops * 1e-9, benchmark::Counter::kIsIterationInvariantRate);
}

/// What an update of n states by m rows cannot do without: P H^T over 13 columns, S, its factor, W, P - W
/// W^T.
double irreducible_flops(double n, double m) {
  return 2.0 * 13.0 * n * m + 13.0 * m * m + m * m * m / 3.0 + n * m * m + n * (n + 1.0) * m;
}

/// The whole of update(): linearisation, gates, P H^T, S, factorisation, downdate, normalisation.
void update(benchmark::State& state) {
  Scene scene(static_cast<int>(state.range(0)), static_cast<int>(state.range(1)));
  for (auto _ : state) {
    scene.filter.predict(1e-3);
    benchmark::DoNotOptimize(scene.filter.update(scene.measurements).nis);
  }
  count_flops(state,
              irreducible_flops(scene.filter.state().size(), 2.0 * static_cast<double>(state.range(1))));
}
BENCHMARK(update)->Args({100, 40})->Args({100, 25})->Args({200, 100})->Unit(benchmark::kMillisecond);

void predict(benchmark::State& state) {
  Scene scene(100, 40);
  for (auto _ : state)
    scene.filter.predict(1e-6);
}
BENCHMARK(predict)->Unit(benchmark::kMicrosecond);

void predict_pixels_of_60(benchmark::State& state) {
  const Scene scene(100, 60);
  for (auto _ : state) {
    for (const Measurement& m : scene.measurements) {
      benchmark::DoNotOptimize(scene.filter.predict_pixel(m.landmark));
    }
  }
}
BENCHMARK(predict_pixels_of_60)->Unit(benchmark::kMicrosecond);

// The irreducible parts of the update, each alone.

void part_innovation(benchmark::State& state) {  // P H^T over the touched columns, and S
  Scene scene(100, 40);
  const GaussianState& x = scene.filter.state();
  JointInnovation innovation(x.size(), 80);
  for (const LinearisedMeasurement& m : scene.filter.innovation(scene.measurements).measurements())
    innovation.push_back(m);
  for (auto _ : state) {
    innovation.compute(x, false);
    benchmark::ClobberMemory();
  }
}
BENCHMARK(part_innovation)->Unit(benchmark::kMillisecond);

void part_factorise(benchmark::State& state) {
  Scene scene(100, 40);
  const JointInnovation& innovation = scene.filter.innovation(scene.measurements);
  CovarianceUpdate update(613, 80);
  for (auto _ : state)
    benchmark::DoNotOptimize(update.factorise(innovation));
}
BENCHMARK(part_factorise)->Unit(benchmark::kMillisecond);

void part_downdate(benchmark::State& state) {
  Scene scene(100, 40);
  const JointInnovation& innovation = scene.filter.innovation(scene.measurements);
  CovarianceUpdate update(613, 80);
  update.factorise(innovation);
  GaussianState copy = scene.filter.state();
  for (auto _ : state) {
    update.downdate(copy);
    benchmark::ClobberMemory();
  }
  count_flops(state, 613.0 * 614.0 * 80.0);
}
BENCHMARK(part_downdate)->Unit(benchmark::kMillisecond);

/// What Eigen's own product reaches on this machine, for scale.
void eigen_gemm_peak(benchmark::State& state) {
  constexpr int kSize = 512;
  const Eigen::MatrixXd A = Eigen::MatrixXd::Random(kSize, kSize);
  const Eigen::MatrixXd B = Eigen::MatrixXd::Random(kSize, kSize);
  Eigen::MatrixXd C(kSize, kSize);
  for (auto _ : state) {
    C.noalias() = A * B;
    benchmark::ClobberMemory();
  }
  count_flops(state, 2.0 * kSize * kSize * kSize);
}
BENCHMARK(eigen_gemm_peak)->Unit(benchmark::kMillisecond);

/// HOHCT of 40 pairings of which the given number is wrong.
void joint_compatibility(benchmark::State& state) {
  Scene scene(100, 40);
  for (int i = 0; i < state.range(0); ++i)
    scene.measurements[static_cast<std::size_t>(7 * i % 40)].z.x() += 30.0;
  const JointInnovation& innovation = scene.filter.innovation(scene.measurements);
  JointCompatibility test;
  int removed = 0;
  for (auto _ : state)
    removed = test.test(innovation).removed;
  state.counters["removed"] = removed;
}
BENCHMARK(joint_compatibility)->DenseRange(0, 4)->Arg(12)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cosight::ekf
