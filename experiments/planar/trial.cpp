#include "experiments/planar/trial.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>

namespace cosight::experiments {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

PlanarFilterOptions filter_options(const TrialOptions& options) {
  PlanarFilterOptions filter = options.filter;
  filter.bearing_sigma = options.world.bearing_sigma_deg * kDegree;
  filter.stereo_bearing_sigma = options.world.stereo_bearing_sigma_deg * kDegree;
  filter.range_sigma = options.world.range_sigma;
  return filter;
}

bool has_overlap(const TrialOptions& options, double t) {
  return options.collaborative && std::any_of(options.overlaps.begin(), options.overlaps.end(),
                                              [t](const Interval& i) { return t >= i.from && t <= i.to; });
}

std::vector<PlanarMeasurement> measurements_of(const std::vector<WallSighting>& seen, bool overlap) {
  std::vector<PlanarMeasurement> measurements;
  for (const WallSighting& s : seen) {
    PlanarMeasurement m{s.landmark, s.bearing, std::nullopt};
    if (overlap) m.stereo = {s.stereo_bearing, s.range};
    measurements.push_back(m);
  }
  return measurements;
}

/// C14: s = |1 - mean(d_i / d^_i)| over the converged landmarks in view, d their distance from the camera.
double scale_error(const WallWorld& world, const PlanarFilter& filter,
                   const std::vector<WallSighting>& in_view) {
  constexpr double kConverged = 0.1;  // sigma_rho / rho
  double sum = 0.0;
  int count = 0;
  for (const PlanarFilter::Landmark& landmark : filter.landmarks()) {
    const bool seen = std::any_of(in_view.begin(), in_view.end(),
                                  [&](const WallSighting& s) { return s.landmark == landmark.id; });
    if (!seen || !(landmark.sigma_rho < kConverged * landmark.rho)) continue;
    const Eigen::Vector2d truth = world.landmarks()[static_cast<std::size_t>(landmark.id)];
    sum += (truth - world.camera().p).norm() / (landmark.point - filter.camera().p).norm();
    ++count;
  }
  return count > 0 ? std::abs(1.0 - sum / count) : std::numeric_limits<double>::quiet_NaN();
}

TrialStep compare(const WallWorld& world, const PlanarFilter& filter, const std::vector<WallSighting>& seen) {
  TrialStep step;
  step.t = world.time();
  step.truth = world.camera();
  step.estimate = filter.camera();
  const Eigen::Vector2d error = step.truth.p - step.estimate.p;
  step.position_error = error.norm();
  step.heading_error =
      std::abs(std::remainder(step.truth.theta - step.estimate.theta, 2.0 * std::numbers::pi));
  step.position_sigma = std::sqrt(filter.position_covariance().trace());
  step.position_nees = error.dot(filter.position_covariance().inverse() * error);
  step.scale_error = scale_error(world, filter, seen);
  return step;
}

/// The paper's metric start: a few landmarks across the view are surveyed, W is where the camera stands.
void start(const WallWorld& world, const TrialOptions& options, std::vector<WallSighting> seen,
           PlanarFilter& filter) {
  std::sort(seen.begin(), seen.end(),
            [](const WallSighting& a, const WallSighting& b) { return a.bearing < b.bearing; });
  const std::size_t known = std::min(seen.size(), static_cast<std::size_t>(options.known_landmarks));
  for (std::size_t k = 0; k < known; ++k) {
    const int landmark = seen[k * (seen.size() - 1) / (known - 1)].landmark;
    filter.add_known_landmark(landmark, world.landmarks()[static_cast<std::size_t>(landmark)],
                              options.known_sigma);
  }
}

}  // namespace

TrialResult run_trial(unsigned seed, const TrialOptions& options) {
  WallWorld world(seed, options.world);
  PlanarFilter filter(filter_options(options), world.camera().theta);
  start(world, options, world.observe(), filter);
  TrialResult result;
  for (int i = 0; i < world.steps(); ++i) {
    world.step();
    filter.predict(options.world.dt);
    const std::vector<WallSighting> seen = world.observe();
    const auto measurements = measurements_of(seen, has_overlap(options, world.time()));
    filter.update(measurements);
    filter.drop_lost_candidates(measurements);
    result.steps.push_back(compare(world, filter, seen));
  }
  result.true_landmarks = world.landmarks();
  result.map = filter.landmarks();
  return result;
}

}  // namespace cosight::experiments
