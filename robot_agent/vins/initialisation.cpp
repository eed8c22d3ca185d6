#include "robot_agent/vins/initialisation.hpp"

#include <algorithm>
#include <cmath>
#include <map>

#include "robot_agent/vins/known_distances.hpp"
#include "robot_agent/vins/misfit.hpp"
#include "robot_agent/vins/triangulation.hpp"
#include "robot_agent/vins/uncertainty.hpp"
#include "robot_agent/vins/velocity_and_gravity.hpp"

namespace cosight::vins {
namespace {

std::size_t tracks_across(const std::vector<UnplacedFrame>& frames) {
  const std::size_t third = frames.size() / 3;
  std::map<FeatureId, int> seen;  // bit 0: in the first third, bit 1: in the last
  for (std::size_t i = 0; i < frames.size(); ++i) {
    const int bit = i < third ? 1 : (i >= frames.size() - third ? 2 : 0);
    for (const TrackedFeature& feature : frames[i].features.features)
      seen[feature.id] |= bit;
  }
  return static_cast<std::size_t>(
      std::count_if(seen.begin(), seen.end(), [](const auto& entry) { return entry.second == 3; }));
}

/// The frames with states predicted from the first one's, and landmarks without depth.
Window place(const std::vector<UnplacedFrame>& frames, const Pose& T_BS, const NavState& state,
             double gravity) {
  Window window;
  window.T_BS = T_BS;
  WindowFrame& first = window.frames.emplace_back();
  first.stamp = frames.front().features.stamp;
  first.state = state;
  window.add_observations(frames.front().features);
  learn_distances(window, frames.front().features);  // later ones would need a scale that is not sure yet
  for (std::size_t i = 1; i < frames.size(); ++i) {
    append_frame(window, frames[i].features, *frames[i].imu, gravity);
  }
  return window;
}

void set_bias(std::vector<UnplacedFrame>& frames, const ImuBias& bias) {
  for (UnplacedFrame& frame : frames) {
    if (frame.imu) frame.imu->repropagate(bias);
  }
}

/// Standard deviation of the distance from the first to the last frame, in parts of it. The first frame is
/// pinned by the prior, so that is the scale's.
double scale_deviation(const Window& window, const GraphOptions& options) {
  const auto P = state_covariance(window, options, window.frames.back().id);
  const Eigen::Vector3d baseline = window.frames.back().state.T_WB.p - window.frames.front().state.T_WB.p;
  const Eigen::Vector3d along = baseline.normalized();
  return std::sqrt(along.dot(P.topLeftCorner<3, 3>() * along)) / baseline.norm();
}

/// State of the first frame from what all of them saw and felt.
std::optional<NavState> closed_form_state(const std::vector<UnplacedFrame>& frames, const Pose& T_BS,
                                          const ImuBias& bias, double gravity) {
  const auto start = estimate_velocity_and_gravity(frames, T_BS, gravity);
  if (!start) return std::nullopt;
  NavState state;
  state.T_WB.q = levelled(start->g_B);
  state.v_W = state.T_WB.q * start->v_B;
  state.bias = bias;
  return state;
}

Prior prior_of_start(const WindowFrame& first, const InitialisationOptions& options, bool at_rest,
                     double gravity) {
  if (at_rest) return rest_prior(first, options.rest, options.prior, gravity);
  // In proportion to the speed, or the prior itself would tell the scale of a fast start.
  StartUncertainty uncertainty = options.prior;
  uncertainty.velocity += first.state.v_W.norm();
  return start_prior(first, uncertainty);
}

/// The window's own least squares on top of the first guess, whose prior it has.
bool refine(Window& window, const InitialisationOptions& options, const WindowOptions& window_options) {
  SolverOptions solver = window_options.solver;
  solver.max_iterations = options.max_iterations;
  solver.graph.trust.mode = TrustMode::kFixed;
  add_calibration_prior(window.prior, window, solver.graph, window_options.calibration);
  triangulate_all(window, solver.graph.min_observations, window_options.default_distance);
  const SolveReport report = solve(window, solver);
  drop_failed_landmarks(window, window_options);
  measure_misfits(window, solver.graph.min_observations);
  return report.usable;
}

}  // namespace

const char* to_string(InitialisationOutcome outcome) {
  switch (outcome) {
    case InitialisationOutcome::kReady:
      return "ready";
    case InitialisationOutcome::kTooFewFrames:
      return "too few frames";
    case InitialisationOutcome::kTooFewTracks:
      return "too few tracks";
    case InitialisationOutcome::kTooLittleParallax:
      return "too little parallax";
    case InitialisationOutcome::kNoSolution:
      return "no solution";
    case InitialisationOutcome::kScaleUnobservable:
      return "scale unobservable";
    case InitialisationOutcome::kInconsistent:
      break;
  }
  return "camera and IMU inconsistent";
}

double median_parallax(const std::vector<UnplacedFrame>& frames, const Pose& T_BS) {
  std::map<FeatureId, std::pair<Eigen::Vector3d, Eigen::Vector3d>> ends;
  Eigen::Quaterniond q_B0B = Eigen::Quaterniond::Identity();
  for (const UnplacedFrame& frame : frames) {
    if (frame.imu) q_B0B = q_B0B * frame.imu->increment().gamma;
    for (const TrackedFeature& feature : frame.features.features) {
      const Eigen::Vector3d ray = q_B0B * (T_BS.q * feature.sighting.bearing());
      ends.try_emplace(feature.id, ray, ray).first->second.second = ray;
    }
  }
  std::vector<double> angles;
  for (const auto& [id, rays] : ends)
    angles.push_back((rays.first - rays.second).norm());
  if (angles.empty()) return 0.0;
  const auto middle = angles.begin() + static_cast<std::ptrdiff_t>(angles.size() / 2);
  std::nth_element(angles.begin(), middle, angles.end());
  return *middle;
}

Initialisation initialise(const std::vector<UnplacedFrame>& given, const Pose& T_BS,
                          const InitialisationOptions& options, const WindowOptions& window_options,
                          const std::optional<Rest>& rest) {
  using enum InitialisationOutcome;
  if (given.size() < options.frames) return {.outcome = kTooFewFrames};
  if (to_seconds(given.back().features.stamp - given.front().features.stamp) < options.min_span) {
    return {.outcome = kTooFewFrames};
  }
  if (tracks_across(given) < options.min_tracks) return {.outcome = kTooFewTracks};

  const double gravity = window_options.solver.graph.gravity;
  std::vector<UnplacedFrame> frames = given;
  ImuBias bias;
  if (rest) {
    bias = state_at(*rest, gravity).bias;
  } else {
    const auto gyroscope_bias = estimate_gyroscope_bias(frames, T_BS);
    if (!gyroscope_bias) return {.outcome = kNoSolution};
    bias.gyroscope = *gyroscope_bias;
  }
  set_bias(frames, bias);
  if (median_parallax(frames, T_BS) < options.min_parallax) return {.outcome = kTooLittleParallax};

  const auto first = rest ? state_at(*rest, gravity) : closed_form_state(frames, T_BS, bias, gravity);
  if (!first) return {.outcome = kNoSolution};
  Window window = place(frames, T_BS, *first, gravity);
  window.prior = prior_of_start(window.frames.front(), options, rest.has_value(), gravity);
  if (!refine(window, options, window_options)) return {.outcome = kNoSolution};

  Initialisation result;
  result.typical_misfit = window.typical_misfit;
  result.scale_deviation = scale_deviation(window, window_options.solver.graph);
  result.outcome = kReady;
  // Features on vehicles can make a path of any speed, and a bias that turns the accelerations to match.
  constexpr double kBelievable = 4.0;
  const double bias_sigma = options.prior.accelerometer_bias;
  if (window.frames.back().state.bias.accelerometer.norm() > kBelievable * bias_sigma) {
    result.outcome = kInconsistent;
  }
  if (!(result.scale_deviation < options.max_scale_deviation)) result.outcome = kScaleUnobservable;
  if (contradicts(check_distances(window))) result.outcome = kInconsistent;
  if (!(result.typical_misfit < options.max_misfit)) result.outcome = kInconsistent;
  if (result.outcome == kReady) result.window = std::move(window);
  return result;
}

}  // namespace cosight::vins
