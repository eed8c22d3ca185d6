#include "robot_agent/vins/track_run.hpp"

#include <algorithm>
#include <cmath>

#include "robot_agent/vins/track_lengths.hpp"
#include "shared/evaluation/association.hpp"
#include "shared/evaluation/error_statistics.hpp"
#include "shared/evaluation/trajectory_errors.hpp"

namespace cosight::vins {
namespace {

/// The first state as the truth has it; velocity by a one-sided difference of second order.
NavState true_first_state(const Trajectory& truth) {
  const double dt = to_seconds(truth[1].stamp - truth[0].stamp);
  NavState state;
  state.T_WB = truth[0].T_WC;
  state.v_W = (-3.0 * truth[0].T_WC.p + 4.0 * truth[1].T_WC.p - truth[2].T_WC.p) / (2.0 * dt);
  return state;
}

/// Share of the features that were tracked too few times (the paper's section 5.2) [%].
double outlier_percent(const TrackSequence& sequence) {
  TrackLengths lengths;
  for (const FeatureFrame& frame : sequence.frames)
    lengths.add(frame);
  lengths.add({});  // what is still followed ends here
  return 100.0 * static_cast<double>(lengths.outlier_sightings()) /
         static_cast<double>(std::max<std::uint64_t>(lengths.sightings(), 1));
}

void measure(const TrackSequence& sequence, TrackRun& run) {
  constexpr double kFramesPerSecond = 10.0;
  constexpr Stamp kSameInstant = 1'000'000;
  const std::vector<PosePair> pairs = associate(run.estimate, sequence.truth, kSameInstant);
  run.rpe = relative_errors(pairs, {.delta = kFramesPerSecond}).translation;
  const ErrorStatistics second = statistics_of(run.rpe);
  TrackMetrics& metrics = run.metrics;
  metrics.rpe_mean = second.mean;
  metrics.rpe_std = std::sqrt(std::max(0.0, second.rmse * second.rmse - second.mean * second.mean));
  metrics.rpe_max = second.max;
  metrics.rpe_frame_mean = statistics_of(relative_errors(pairs, {.delta = 1.0}).translation).mean;
  metrics.drift_percent = 100.0 * position_errors(pairs).back() / true_path_length(pairs);
  metrics.outlier_percent = outlier_percent(sequence);
}

}  // namespace

TrackRun run_tracks(const TrackSequence& sequence, const TrackRunOptions& options,
                    const std::atomic<bool>* stop) {
  WindowOptions window = options.window;
  window.solver.graph.gravity = sequence.gravity;
  WindowOdometry odometry(window, options.noise, sequence.T_BS);
  odometry.start(sequence.frames.front(), true_first_state(sequence.truth), options.start);
  ImuBuffer imu;
  for (const ImuSample& sample : sequence.imu)
    imu.push(sample);

  TrackRun run;
  run.estimate.push_back(sequence.truth.front());
  std::vector<double> solve_ms;
  std::vector<double> marginalise_ms;
  for (std::size_t i = 1; i < std::min(sequence.frames.size(), options.max_frames); ++i) {
    if (stop != nullptr && *stop) return run;
    const Stamp from = sequence.frames[i - 1].stamp;
    const Stamp to = sequence.frames[i].stamp;
    imu.drop_before(from);
    if (!imu.covers(from, to)) break;
    const WindowReport report = odometry.process(sequence.frames[i], imu.between(from, to));
    run.estimate.push_back({to, report.state.T_WB});
    solve_ms.push_back(report.solve_ms);
    marginalise_ms.push_back(report.marginalise_ms);
    run.reports.push_back(report);
  }
  measure(sequence, run);
  run.solve_ms_median = quantile(solve_ms, 0.5);
  run.solve_ms_p99 = quantile(solve_ms, 0.99);
  run.marginalise_ms_median = quantile(marginalise_ms, 0.5);
  return run;
}

}  // namespace cosight::vins
