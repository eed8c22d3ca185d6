#include "robot_agent/vins/track_run.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <map>
#include <numeric>
#include <utility>

namespace cosight::vins {
namespace {

/// The first state as the truth has it; velocity by a one-sided difference of second order.
NavState true_first_state(const TrackSequence& sequence) {
  const auto& truth = sequence.truth;
  const double dt = to_seconds(truth[1].stamp - truth[0].stamp);
  NavState state;
  state.T_WB = truth[0].T_WB;
  state.v_W = (-3.0 * truth[0].T_WB.p + 4.0 * truth[1].T_WB.p - truth[2].T_WB.p) / (2.0 * dt);
  return state;
}

double quantile(std::vector<double> values, double q) {
  if (values.empty()) return 0.0;
  const auto at = values.begin() + static_cast<std::ptrdiff_t>(q * static_cast<double>(values.size() - 1));
  std::nth_element(values.begin(), at, values.end());
  return *at;
}

double mean(const std::vector<double>& values) {
  return std::accumulate(values.begin(), values.end(), 0.0) /
         static_cast<double>(std::max<std::size_t>(values.size(), 1));
}

double path_length(const std::vector<TrackSequence::TruePose>& truth) {
  double length = 0.0;
  for (std::size_t i = 1; i < truth.size(); ++i)
    length += (truth[i].T_WB.p - truth[i - 1].T_WB.p).norm();
  return length;
}

/// Share of the features that were tracked fewer than ten times (the paper's section 5.2) [%].
double outlier_percent(const TrackSequence& sequence) {
  constexpr int kInlierTracks = 10;
  std::map<FeatureId, int> tracked;
  for (const FeatureFrame& frame : sequence.frames) {
    for (const TrackedFeature& feature : frame.features)
      ++tracked[feature.id];
  }
  int all = 0;
  int outliers = 0;
  for (const auto& [id, count] : tracked) {
    all += count;
    if (count < kInlierTracks) outliers += count;
  }
  return 100.0 * outliers / std::max(all, 1);
}

TrackMetrics measure(const TrackSequence& sequence, const std::vector<Pose>& estimate) {
  TrackMetrics metrics;
  constexpr std::size_t kFramesPerSecond = 10;
  const std::vector<double> errors = relative_errors(sequence.truth, estimate, kFramesPerSecond);
  metrics.rpe_mean = mean(errors);
  double squares = 0.0;
  for (double error : errors)
    squares += (error - metrics.rpe_mean) * (error - metrics.rpe_mean);
  metrics.rpe_std = std::sqrt(squares / static_cast<double>(errors.size()));
  metrics.rpe_max = *std::max_element(errors.begin(), errors.end());
  metrics.rpe_frame_mean = mean(relative_errors(sequence.truth, estimate, 1));
  metrics.drift_percent =
      100.0 * (estimate.back().p - sequence.truth.back().T_WB.p).norm() / path_length(sequence.truth);
  metrics.outlier_percent = outlier_percent(sequence);
  return metrics;
}

}  // namespace

std::vector<double> relative_errors(const std::vector<TrackSequence::TruePose>& truth,
                                    const std::vector<Pose>& estimate, std::size_t step) {
  std::vector<double> errors;
  for (std::size_t i = 0; i + step < estimate.size(); i += step) {
    const Pose true_motion = truth[i].T_WB.inverse() * truth[i + step].T_WB;
    const Pose motion = estimate[i].inverse() * estimate[i + step];
    errors.push_back((true_motion.inverse() * motion).p.norm());
  }
  return errors;
}

TrackRun run_tracks(const TrackSequence& sequence, const TrackRunOptions& options) {
  WindowOptions window = options.window;
  window.solver.graph.gravity = sequence.gravity;
  WindowOdometry odometry(window, options.noise, sequence.T_BS);
  odometry.start(sequence.frames.front(), true_first_state(sequence), options.start);
  ImuBuffer imu;
  for (const ImuSample& sample : sequence.imu)
    imu.push(sample);

  TrackRun run;
  std::vector<Pose> estimate{sequence.truth.front().T_WB};
  std::vector<double> solve_ms;
  std::vector<double> marginalise_ms;
  for (std::size_t i = 1; i < sequence.frames.size(); ++i) {
    const Stamp from = sequence.frames[i - 1].stamp;
    const Stamp to = sequence.frames[i].stamp;
    imu.drop_before(from);
    if (!imu.covers(from, to)) break;
    run.reports.push_back(odometry.process(sequence.frames[i], imu.between(from, to)));
    estimate.push_back(run.reports.back().state.T_WB);
    solve_ms.push_back(run.reports.back().solve_ms);
    marginalise_ms.push_back(run.reports.back().marginalise_ms);
  }
  run.metrics = measure(sequence, estimate);
  run.solve_ms_median = quantile(solve_ms, 0.5);
  run.solve_ms_p99 = quantile(solve_ms, 0.99);
  run.marginalise_ms_median = quantile(marginalise_ms, 0.5);
  return run;
}

void write_tum(const TrackRun& run, const std::filesystem::path& file) {
  std::ofstream out(file);
  out << std::fixed << std::setprecision(9);
  for (const WindowReport& report : run.reports) {
    const Pose& T = report.state.T_WB;
    out << to_seconds(report.stamp) << ' ' << T.p.x() << ' ' << T.p.y() << ' ' << T.p.z() << ' ' << T.q.x()
        << ' ' << T.q.y() << ' ' << T.q.z() << ' ' << T.q.w() << '\n';
  }
  if (!out) throw TrackFileError(file.string() + ": cannot be written");
}

}  // namespace cosight::vins
