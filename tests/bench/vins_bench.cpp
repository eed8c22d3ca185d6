// One window of the odometry at the size of the target: 11 frames, 150 features a frame.
#include <benchmark/benchmark.h>

#include "robot_agent/vins/marginalisation.hpp"
#include "robot_agent/vins/misfit.hpp"
#include "robot_agent/vins/sliding_window.hpp"
#include "robot_agent/vins/triangulation.hpp"
#include "robot_agent/vins/window_odometry.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

/// A drive in its third second, just before the newest frame is solved for.
Window unsolved_window(const WindowOptions& options) {
  SyntheticDrive drive(1, 600);
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, 0.25), drive.state(0.0), {});
  constexpr int kFrames = 30;
  for (int i = 1; i < kFrames; ++i) {
    odometry.process(drive.camera(0.1 * i, 0.25), drive.imu(0.1 * i - 0.1, 0.1 * i));
  }
  Window window = odometry.window();
  const double t = 0.1 * kFrames;
  append_frame(window, drive.camera(t, 0.25),
               {drive.imu(t - 0.1, t), window.frames.back().state.bias, drive.noise}, drive.gravity);
  triangulate_all(window, options.solver.graph.min_observations, options.default_distance);
  update_geometry_factors(window);
  measure_misfits(window, options.solver.graph.min_observations);
  return window;
}

void solve_window(benchmark::State& state) {
  const WindowOptions options;
  const Window start = unsolved_window(options);
  for (auto step : state) {
    state.PauseTiming();
    Window window = start;
    state.ResumeTiming();
    benchmark::DoNotOptimize(solve(window, options.solver));
  }
}
BENCHMARK(solve_window)->Unit(benchmark::kMillisecond);

void marginalise(benchmark::State& state) {
  const WindowOptions options;
  Window window = unsolved_window(options);
  solve(window, options.solver);
  for (auto step : state)
    benchmark::DoNotOptimize(marginalise_oldest(window, options.solver.graph));
}
BENCHMARK(marginalise)->Unit(benchmark::kMillisecond);

}  // namespace
}  // namespace cosight::vins
