#include "experiments/consistency/consistency_run.hpp"

#include <Eigen/Cholesky>
#include <algorithm>
#include <cmath>
#include <ctime>
#include <numbers>

#include "robot_agent/ekf/triangulation.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::experiments {
namespace {

using ekf::Measurement;

constexpr int kKeyframeInterval = 5;  // steps between searches for candidates
constexpr int kMaxClones = 12;

CameraModel camera_model() {
  return {.fx = FeatureWorld::kFocal,
          .fy = FeatureWorld::kFocal,
          .cx = 0.5 * FeatureWorld::kWidth,
          .cy = 0.5 * FeatureWorld::kHeight,
          .width = FeatureWorld::kWidth,
          .height = FeatureWorld::kHeight};
}

ekf::FilterOptions filter_options(const RunOptions& options) {
  ekf::FilterOptions filter = options.filter;
  filter.max_landmarks = options.map_size;
  filter.max_clones = kMaxClones;
  filter.motion = {options.world.sigma_acceleration, options.world.sigma_angular_acceleration};
  filter.pixel_sigma = options.world.pixel_sigma * std::sqrt(options.claimed_variance);
  filter.gate_probability = 1.0;
  return filter;
}

/// What this thread has computed for [s]: of no matter what else runs on the machine.
double thread_cpu_s() {
  timespec now{};
  clock_gettime(CLOCK_THREAD_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

const FeatureWorld::Seen* find(const std::vector<FeatureWorld::Seen>& seen, int point) {
  const auto found =
      std::find_if(seen.begin(), seen.end(), [point](const auto& s) { return s.point == point; });
  return found == seen.end() ? nullptr : &*found;
}

}  // namespace

ConsistencyRun::ConsistencyRun(unsigned seed, const RunOptions& options)
    : options_(options),
      world_(seed, options.world),
      filter_(camera_model(), filter_options(options)),
      spoiler_(seed + 1'000'003U),
      validator_(options.validation) {
  rig_.camera_S = camera_model();
  rig_.camera_F = camera_model();
  rig_.sigma_pixel_S = filter_.options().pixel_sigma;
  rig_.sigma_pixel_F = filter_.options().pixel_sigma;
  const double p = options.claimed_variance * options.world.wearer_sigma_p * options.world.wearer_sigma_p;
  const double theta =
      options.claimed_variance * options.world.wearer_sigma_theta * options.world.wearer_sigma_theta;
  rig_.T_SF.covariance.diagonal() << p, p, p, theta, theta, theta;
  start();
}

/// Pose and velocities known with errors that are drawn from what the filter is told.
void ConsistencyRun::start() {
  constexpr double kSigmaP = 0.005;      // [m]
  constexpr double kSigmaTheta = 0.001;  // [rad]
  constexpr double kSigmaV = 0.05;       // [m/s]
  constexpr double kSigmaOmega = 0.02;   // [rad/s]
  UncertainPose T_WS;
  T_WS.T.q = Eigen::Quaterniond(FeatureWorld::rodrigues(kSigmaTheta * world_.draw()) * world_.camera().R);
  T_WS.T.p = world_.camera().p + kSigmaP * world_.draw();
  T_WS.covariance.diagonal().head<3>().setConstant(kSigmaP * kSigmaP);
  T_WS.covariance.diagonal().tail<3>().setConstant(kSigmaTheta * kSigmaTheta);
  filter_.reset(T_WS, kSigmaV, kSigmaOmega);
  ekf::CameraState x = filter_.camera();
  x.v_W = world_.velocity() + kSigmaV * world_.draw();
  x.omega_S = world_.angular_velocity() + kSigmaOmega * world_.draw();
  filter_.reset(x, filter_.camera_covariance());
}

bool ConsistencyRun::wearer_looks() const {
  return step_ < options_.last_glance && step_ % options_.glance_period < options_.glance_steps;
}

StepResult ConsistencyRun::step() {
  world_.step();
  filter_.predict(options_.world.dt);
  const Sightings seen = world_.observe(wearer_looks());
  const FeatureWorld::Body wearer = world_.measured_wearer();
  rig_.T_SF.T = {Eigen::Quaterniond(wearer.R), wearer.p};
  StepResult result;
  measure(seen, result);
  forget_unseen(seen);
  start_from_wearer(seen);
  if (options_.delayed_starts) start_delayed(seen);
  compare(result);
  ++step_;
  return result;
}

std::vector<Measurement> ConsistencyRun::measurements_of(const Sightings& seen) const {
  std::vector<Measurement> measurements;
  for (const FeatureWorld::Seen& s : seen) {
    const auto known = map_.find(s.point);
    if (known == map_.end()) continue;
    const bool as_point = options_.wearer_form == WearerForm::kPoint && has_depth(s);
    const auto point = as_point ? measure_point({s.pixel_S, *s.pixel_F}, rig_) : std::nullopt;
    measurements.push_back(point
                               ? Measurement::point(known->second, *point)
                               : Measurement::pixel(known->second, s.pixel_S, filter_.options().pixel_sigma));
    if (options_.wearer_form == WearerForm::kPixel && s.pixel_F)
      measurements.push_back(Measurement::wearer_pixel(known->second, *s.pixel_F, rig_.sigma_pixel_F));
  }
  return measurements;
}

std::vector<char> ConsistencyRun::spoil(std::vector<Measurement>& measurements) {
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  const auto offset = [&] {
    const double angle = 2.0 * std::numbers::pi * unit(spoiler_);
    const double length =
        options_.wrong.min_px + (options_.wrong.max_px - options_.wrong.min_px) * unit(spoiler_);
    return Eigen::Vector2d(length * std::cos(angle), length * std::sin(angle));
  };
  const Eigen::Vector2d common = offset();
  std::vector<char> is_wrong;
  for (Measurement& m : measurements) {
    is_wrong.push_back(unit(spoiler_) < options_.wrong.share ? 1 : 0);
    const Eigen::Vector2d own = offset();
    if (is_wrong.back() != 0) m.z.head<2>() += options_.wrong.repeated ? common : own;
  }
  return is_wrong;
}

void ConsistencyRun::validate(std::vector<Measurement>& measurements, std::vector<char>& is_wrong,
                              MatchCounts& counts) {
  constexpr double kGate = 0.99;
  const ekf::ChiSquaredLimits limits(kGate, 3);
  const auto keep_those = [&](auto passes) {
    const auto linearised = filter_.innovation(measurements, &rig_).measurements();
    std::vector<Measurement> kept;
    std::vector<char> kept_wrong;
    for (std::size_t i = 0; i < linearised.size(); ++i) {
      if (!passes(i, linearised[i])) continue;
      const auto index = static_cast<std::size_t>(linearised[i].measurement);
      kept.push_back(measurements[index]);
      kept_wrong.push_back(is_wrong[index]);
    }
    measurements = kept;
    is_wrong = kept_wrong;
  };
  keep_those([&](std::size_t, const auto& m) { return m.nis <= limits(m.rows); });
  const ekf::JointInnovation& joint = filter_.innovation(measurements, &rig_);
  const double start = thread_cpu_s();
  const std::vector<char> keep = validator_.test(joint);
  counts.validation_s = thread_cpu_s() - start;
  keep_those([&](std::size_t i, const auto&) { return keep[i] != 0; });
}

void ConsistencyRun::measure(const Sightings& seen, StepResult& result) {
  std::vector<Measurement> measurements = measurements_of(seen);
  std::vector<char> is_wrong = spoil(measurements);
  const auto count_wrong = [&] { return static_cast<int>(std::count(is_wrong.begin(), is_wrong.end(), 1)); };
  result.matches.wrong = count_wrong();
  result.matches.right = static_cast<int>(is_wrong.size()) - result.matches.wrong;
  if (options_.validation != Validation::kNone) validate(measurements, is_wrong, result.matches);
  result.matches.wrong_fused = count_wrong();
  result.matches.right_fused = static_cast<int>(is_wrong.size()) - result.matches.wrong_fused;
  const ekf::UpdateReport& report = filter_.update(measurements, &rig_);
  result.joint = {report.nis, static_cast<double>(report.rows)};
  for (const ekf::MeasurementReport& m : report.measurements) {
    if (m.outcome != ekf::Outcome::kFused) continue;
    NisSum& sum = m.kind == ekf::MeasurementKind::kPixel ? result.pixels : result.points;
    sum.nis += m.nis;
    sum.rows += m.rows;
  }
}

void ConsistencyRun::forget_unseen(const Sightings& seen) {
  std::erase_if(map_, [&](const auto& entry) {
    if (find(seen, entry.first) != nullptr) return false;
    filter_.remove_landmark(entry.second);
    return true;
  });
  std::erase_if(candidates_, [&](const auto& entry) { return find(seen, entry.first) == nullptr; });
}

/// Chosen by the truth: to choose by measured parallax favours points that look nearer than they are.
bool ConsistencyRun::has_depth(const FeatureWorld::Seen& seen) const {
  constexpr double kFar = 10.0;  // [m]
  return seen.pixel_F && world_.distance(seen.point) < kFar;
}

void ConsistencyRun::start_from_wearer(const Sightings& seen) {
  std::vector<ekf::StereoMatch> matches;
  std::vector<int> points;
  for (const FeatureWorld::Seen& s : seen) {
    if (map_.contains(s.point) || !has_depth(s)) continue;
    if (static_cast<int>(map_.size() + points.size()) >= options_.map_size) break;
    matches.push_back({s.pixel_S, *s.pixel_F});
    points.push_back(s.point);
  }
  std::vector<std::optional<ekf::LandmarkId>> ids;
  if (options_.correlated_starts) {
    ids = filter_.add_pseudo_stereo_landmarks(matches, rig_);
  } else {
    for (const ekf::StereoMatch& match : matches)
      ids.push_back(filter_.add_pseudo_stereo_landmark(match, rig_));
  }
  for (std::size_t i = 0; i < ids.size(); ++i) {
    if (!ids[i]) continue;
    map_[points[i]] = *ids[i];
    candidates_.erase(points[i]);
  }
}

void ConsistencyRun::start_delayed(const Sightings& seen) {
  std::erase_if(candidates_, [&](const auto& entry) {
    const auto& [point, candidate] = entry;
    const Eigen::Vector2d& pixel = find(seen, point)->pixel_S;
    if (!filter_.has_room() || !has_parallax(candidate, pixel)) return false;
    if (const auto id = start_from(candidate, pixel)) map_[point] = *id;
    return true;
  });
  drop_unused_clones();
  if (step_ % kKeyframeInterval == 0) find_candidates(seen);
}

std::optional<ekf::LandmarkId> ConsistencyRun::start_from(const Candidate& candidate,
                                                          const Eigen::Vector2d& pixel) {
  if (candidate.clone) return filter_.add_delayed_landmark(*candidate.clone, candidate.first.pixel, pixel);
  return filter_.add_delayed_landmark(candidate.first, pixel);
}

bool ConsistencyRun::has_parallax(const Candidate& candidate, const Eigen::Vector2d& pixel) const {
  constexpr double kMinParallax = 1.5 * std::numbers::pi / 180.0;
  constexpr double kMinBaseline = 0.03;  // [m]
  const Pose now = filter_.camera().T_WS();
  const auto clone = candidate.clone ? filter_.clone(*candidate.clone) : std::nullopt;
  const Pose first = clone ? clone->T : candidate.first.T_WS.T;
  const auto ray_first = rig_.camera_S.unproject(candidate.first.pixel);
  const auto ray_now = rig_.camera_S.unproject(pixel);
  const Eigen::Vector3d b = now.p - first.p;
  if (b.norm() < kMinBaseline || !ray_first || !ray_now) return false;
  const auto depth = ekf::inverse_depth_by_sines(now.q * *ray_now, first.q * *ray_first, b);
  return depth && depth->rho > 0.0 && depth->parallax > kMinParallax;
}

void ConsistencyRun::find_candidates(const Sightings& seen) {
  constexpr std::size_t kMaxCandidates = 40;
  std::optional<ekf::CloneId> clone;
  if (options_.first_pose == FirstPose::kCloned) {
    clone = filter_.clone_camera_pose();
    if (!clone) return;
    clones_.push_back(*clone);
  }
  const UncertainPose T_WS = filter_.T_WS();
  for (const FeatureWorld::Seen& s : seen) {
    if (candidates_.size() >= kMaxCandidates) break;
    if (!map_.contains(s.point)) candidates_.try_emplace(s.point, Candidate{{T_WS, s.pixel_S}, clone, step_});
  }
  drop_unused_clones();
}

void ConsistencyRun::drop_unused_clones() {
  std::erase_if(clones_, [&](ekf::CloneId id) {
    const bool used = std::any_of(candidates_.begin(), candidates_.end(),
                                  [id](const auto& entry) { return entry.second.clone == id; });
    if (!used) filter_.drop_clone(id);
    return !used;
  });
}

void ConsistencyRun::compare(StepResult& result) const {
  const UncertainPose estimate = filter_.T_WS();
  Eigen::Matrix<double, 6, 1> error;
  error.head<3>() = world_.camera().p - estimate.T.p;
  error.tail<3>() = quaternion_log(
      Eigen::Quaterniond(world_.camera().R * estimate.T.q.toRotationMatrix().transpose()).normalized());
  const Eigen::Matrix3d P_position = estimate.covariance.topLeftCorner<3, 3>();
  result.pose_nees = error.dot(estimate.covariance.llt().solve(error));
  result.position_nees = error.head<3>().dot(P_position.llt().solve(error.head<3>()));
  result.position_error = error.head<3>().norm();
  result.heading_error = error.tail<3>().norm();
  result.landmarks = filter_.landmark_count();
}

}  // namespace cosight::experiments
