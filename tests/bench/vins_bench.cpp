// One window of the odometry at the size of the target: 11 frames, 150 features a frame.
#include <benchmark/benchmark.h>

#include <ctime>

#include "robot_agent/vins/marginalisation.hpp"
#include "robot_agent/vins/misfit.hpp"
#include "robot_agent/vins/sliding_window.hpp"
#include "robot_agent/vins/triangulation.hpp"
#include "robot_agent/vins/window_odometry.hpp"
#include "shared/evaluation/error_statistics.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

/// A drive with 11 frames of 150 features in its window.
class Drive {
 public:
  Drive() : odometry_(options, drive_.noise, drive_.T_BS()) {
    odometry_.start(seen(), drive_.state(0.0), {});
    for (int i = 1; i < 20; ++i)
      next_unsolved();
  }

  /// As it is just before the next frame is solved for; the drive goes on.
  Window next_unsolved() {
    t_ += kInterval;
    const FeatureFrame frame = seen();
    const std::vector<ImuSample> imu = drive_.imu(t_ - kInterval, t_);
    Window window = odometry_.window();
    odometry_.process(frame, imu);
    append_frame(window, frame, {imu, window.frames.back().state.bias, drive_.noise}, drive_.gravity);
    triangulate_all(window, options.solver.graph.min_observations, options.default_distance);
    update_geometry_factors(window);
    measure_misfits(window, options.solver.graph.min_observations);
    return window;
  }

  WindowOptions options;

 private:
  static constexpr double kInterval = 0.1;

  FeatureFrame seen() {
    constexpr double kPixelNoise = 0.25;
    FeatureFrame frame = drive_.camera(t_, kPixelNoise);
    if (frame.features.size() > 150) frame.features.resize(150);
    return frame;
  }

  SyntheticDrive drive_{1, 900};
  double t_ = 0.0;
  WindowOdometry odometry_;
};

double thread_cpu_ms() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return 1e3 * static_cast<double>(now.tv_sec) + 1e-6 * static_cast<double>(now.tv_nsec);
}

/// One window after another; the slow ones matter, so each is timed by itself.
void solve_window(benchmark::State& state) {
  Drive drive;
  std::vector<double> ms;
  double factors = 0.0;
  for (auto step : state) {
    state.PauseTiming();
    Window window = drive.next_unsolved();
    state.ResumeTiming();
    const double start = thread_cpu_ms();
    factors += solve(window, drive.options.solver).visual_terms;
    ms.push_back(thread_cpu_ms() - start);
  }
  state.counters["ms_p50"] = quantile(ms, 0.5);
  state.counters["ms_p99"] = quantile(ms, 0.99);
  state.counters["factors"] = factors / static_cast<double>(ms.size());
}
BENCHMARK(solve_window)->Unit(benchmark::kMillisecond)->Iterations(200);

void marginalise(benchmark::State& state) {
  Drive drive;
  Window window = drive.next_unsolved();
  solve(window, drive.options.solver);
  for (auto step : state)
    benchmark::DoNotOptimize(marginalise_oldest(window, drive.options.solver.graph));
}
BENCHMARK(marginalise)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cosight::vins
