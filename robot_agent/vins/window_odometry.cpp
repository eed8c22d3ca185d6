#include "robot_agent/vins/window_odometry.hpp"

#include <algorithm>
#include <chrono>
#include <utility>

#include "robot_agent/vins/known_distances.hpp"
#include "robot_agent/vins/misfit.hpp"
#include "robot_agent/vins/triangulation.hpp"

namespace cosight::vins {
namespace {

/// Wall time since it was made [ms]; for the report only.
class Stopwatch {
 public:
  double ms() const {
    return std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start_).count();
  }

 private:
  std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

int count_tracked(const Window& window, const FeatureFrame& frame) {
  return static_cast<int>(
      std::count_if(frame.features.begin(), frame.features.end(),
                    [&](const auto& feature) { return window.landmarks.at(feature.id).times_tracked > 1; }));
}

double mean_times_tracked(const Window& window, const FeatureFrame& frame) {
  double sum = 0.0;
  for (const TrackedFeature& feature : frame.features)
    sum += window.landmarks.at(feature.id).times_tracked;
  return frame.features.empty() ? 0.0 : sum / static_cast<double>(frame.features.size());
}

}  // namespace

void WindowOdometry::start(const FeatureFrame& frame, const NavState& state,
                           const StartUncertainty& uncertainty) {
  const Pose T_BS = window_.T_BS;
  window_ = Window();
  learned_ = settled_ = frame.stamp;
  window_.T_BS = T_BS;
  WindowFrame first;
  first.stamp = frame.stamp;
  first.state = state;
  window_.prior = start_prior(first, uncertainty);
  add_calibration_prior(window_.prior, window_, options_.solver.graph, options_.calibration);
  window_.frames.push_back(std::move(first));
  window_.add_observations(frame);
}

void WindowOdometry::start(Window window, bool is_sure) {
  window_ = std::move(window);
  const Stamp now = window_.frames.back().stamp;
  learned_ = now + from_seconds(options_.learning_time);
  settled_ = is_sure ? learned_ : std::max(learned_, now + from_seconds(options_.settling_time));
  while (window_.frames.size() >= options_.size)
    slide(window_, true, options_);
}

WindowReport WindowOdometry::report_of_start() const {
  const WindowFrame& newest = window_.frames.back();
  WindowReport report{.stamp = newest.stamp, .state = newest.state, .predicted = newest.state};
  report.solve.usable = true;
  return report;
}

WindowReport WindowOdometry::process(const FeatureFrame& frame, std::vector<ImuSample> imu) {
  const GraphOptions& graph = options_.solver.graph;
  WindowReport report;
  report.stamp = frame.stamp;
  append_frame(window_, frame, {std::move(imu), window_.frames.back().state.bias, noise_}, graph.gravity);
  learn_distances(window_, frame);
  report.predicted = window_.frames.back().state;
  report.keyframe = second_newest_is_keyframe(window_, options_.keyframe);
  report.tracked = count_tracked(window_, frame);

  triangulate_all(window_, graph.min_observations, options_.default_distance);
  update_geometry_factors(window_);
  measure_misfits(window_, graph.min_observations, frame.stamp >= learned_);
  if (frame.stamp >= settled_) watch_for_movers(window_, graph.trust);
  const Stopwatch solve_time;
  report.solve = solve(window_, options_.solver);
  report.solve_ms = solve_time.ms();
  report.state = window_.frames.back().state;
  report.geometry_factor = window_.frames.back().geometry_factor;
  report.typical_misfit = window_.typical_misfit;
  report.distances = check_distances(window_);
  report.many_bend = window_.many_bend;
  report.mean_times_tracked = mean_times_tracked(window_, frame);

  report.landmarks_dropped = drop_failed_landmarks(window_, options_);
  const Stopwatch marginalise_time;
  if (window_.frames.size() >= options_.size) slide(window_, report.keyframe, options_);
  report.marginalise_ms = marginalise_time.ms();
  repropagate_where_needed(window_, options_);
  return report;
}

}  // namespace cosight::vins
