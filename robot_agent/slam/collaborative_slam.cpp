#include "robot_agent/slam/collaborative_slam.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

#include "robot_agent/slam/prediction_summary.hpp"
#include "robot_agent/slam/rig_refinement.hpp"
#include "robot_agent/slam/start_landmarks.hpp"
#include "robot_agent/slam/stereo_depths.hpp"
#include "robot_agent/slam/stopwatch.hpp"
#include "robot_agent/slam/wearer_silhouette.hpp"
#include "robot_agent/vision/patch_warp.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::slam {
namespace {

ekf::FilterOptions filter_options(const SlamOptions& options) {
  ekf::FilterOptions result;
  result.motion = {options.motion.sigma_acceleration, options.motion.sigma_angular_acceleration};
  result.max_landmarks = options.map.max_landmarks + 20;  // known points and a frame's new ones
  result.max_clones = options.candidates.first_pose == FirstPose::kCloned
                          ? options.candidates.max_age_frames / options.candidates.keyframe_interval + 2
                          : 0;
  result.pixel_sigma = options.search.pixel_sigma;
  result.max_iterations = options.search.max_iterations;
  result.gate_probability = options.search.gate_probability;
  result.correlated_wearer_pose = options.pseudo_stereo.correlated_updates;
  result.rig_error = {.is_state = options.pseudo_stereo.pose_error_is_state,
                      .correlation_time = options.pseudo_stereo.pose_error_time_s};
  return result;
}

vision::CornerOptions corner_options(const MapOptions& options) {
  vision::CornerOptions result;
  result.min_distance = options.min_distance_px;
  return result;
}

UncertainPose start_pose(const StartOptions& start) {
  UncertainPose T_WS;
  T_WS.T = start.T_WS;
  T_WS.covariance.diagonal().head<3>().setConstant(start.sigma_position * start.sigma_position);
  T_WS.covariance.diagonal().tail<3>().setConstant(start.sigma_rotation * start.sigma_rotation);
  return T_WS;
}

}  // namespace

CollaborativeSlam::CollaborativeSlam(const CameraModel& camera_S, const SlamOptions& options,
                                     std::vector<KnownPoint> known_points, WallClock clock)
    : options_(options),
      known_points_(std::move(known_points)),
      clock_(std::move(clock)),
      filter_(camera_S, filter_options(options)),
      compatibility_({.probability = options.search.gate_probability,
                      .each_probability = options.search.each_probability}),
      search_(options.search),
      candidates_(options.candidates, options.search.pixel_sigma),
      wearer_matcher_(options.pseudo_stereo, options.search.pixel_sigma, options.map.min_distance_px,
                      options.seed),
      yaw_offset_(options.yaw_offset),
      maintenance_(options.map),
      motion_prior_(options.seed),
      corners_(corner_options(options.map)),
      health_(options.health) {
  filter_.reset(start_pose(options.start), options.motion.start_sigma_velocity,
                options.motion.start_sigma_angular_velocity);
}

FrameEstimate CollaborativeSlam::process(const FrameBundle& bundle) {
  FrameEstimate estimate;
  estimate.stamp = bundle.stamp;
  estimate.sequence = bundle.sequence;
  Stopwatch watch(clock_);

  if (has_map_ && health_.needs_reset(bundle.stamp)) leave_map(bundle.stamp);
  const bool known_motion = advance_to(bundle);  // predict, or find the motion in the images
  watch.lap(estimate.timings.predict);

  see_wearer(bundle);
  std::vector<Sighting> sightings;  // search
  if (bundle.image)
    sightings = search_.find(*bundle.image, filter_, tracks_, known_motion, silhouette_, estimate.search);
  watch.lap(estimate.timings.search);

  auto view = wearer_view(bundle, sightings, estimate);  // overlap
  watch.lap(estimate.timings.overlap);

  WornMatches matches;  // pseudo-stereo
  if (view) {
    view_stamp_ = bundle.stamp;
    if (!first_view_stamp_) first_view_stamp_ = bundle.stamp;
    matches = wearer_matcher_.match(*view, *bundle.image, sightings, filter_, tracks_, !has_map_,
                                    estimate.pseudo_stereo);
    learn_yaw_offset(*bundle.wearer, *view);
  }
  const auto measurements = wearer_matcher_.measure(view, sightings, matches, estimate.pseudo_stereo);
  watch.lap(estimate.timings.pseudo_stereo);

  const auto rig = view ? std::optional(view->sensed_rig()) : std::nullopt;
  const ekf::StereoRig* wearer = rig ? &*rig : nullptr;
  const auto accepted = validate(measurements, wearer, estimate);
  watch.lap(estimate.timings.validate);

  const ekf::UpdateReport& report = filter_.update(accepted, wearer);
  note_fused(sightings, report, estimate);
  if (view) estimate.stereo_depths = fused_depths(view->rig, sightings, matches.landmarks, report);
  watch.lap(estimate.timings.update);

  if (bundle.image) renew_map(*bundle.image, view, matches, estimate, watch);
  describe(estimate);
  estimate.timings.total = watch.total();
  return estimate;
}

bool CollaborativeSlam::advance_to(const FrameBundle& bundle) {
  if (bundle.image) tracker_.advance(*bundle.image);
  const double dt = last_stamp_ ? to_seconds(bundle.stamp - *last_stamp_) : 0.0;
  last_stamp_ = bundle.stamp;
  // Without a scale nothing can be estimated: W begins where the first depth is seen.
  if (!has_map_) return false;
  const ekf::CameraState before = filter_.camera();
  filter_.predict(dt);
  if (bundle.twist && dt > 0.0) filter_.update_twist(*bundle.twist);
  const auto& predictions = search_.predict(filter_, tracks_);
  if (dt <= 0.0 || !bundle.image || !is_wide(predictions)) return false;
  const auto T_WS = motion_prior_.find(tracker_, filter_, tracks_);
  if (!T_WS) return false;
  filter_.recentre_camera(moved(before, *T_WS, dt));
  search_.predict(filter_, tracks_);
  return true;
}

void CollaborativeSlam::see_wearer(const FrameBundle& bundle) {
  silhouette_.clear();
  if (!bundle.wearer || !may_use_wearer(bundle.stamp)) return;
  silhouette_ = wearer_silhouette(filter_.camera_model(), filter_.camera().T_WS(), bundle.wearer->T_SF.T,
                                  options_.body);
}

bool CollaborativeSlam::is_wide(const std::vector<ekf::PixelPrediction>& predictions) const {
  if (predictions.empty()) return !tracks_.all().empty();
  return median_sigma(predictions) > options_.search.wide_prior_px;
}

bool CollaborativeSlam::may_use_wearer(Stamp stamp) const {
  if (options_.mode == Mode::kCollaborative || !scale_stamp_)
    return options_.mode == Mode::kCollaborative || known_points_.empty();
  return to_seconds(stamp - *scale_stamp_) < options_.start.overlap_s;
}

bool CollaborativeSlam::is_wearer_due(Stamp stamp) const {
  if (!has_map_ || !view_stamp_) return true;
  return to_seconds(stamp - *view_stamp_) >= options_.pseudo_stereo.interval_s;
}

std::optional<StereoView> CollaborativeSlam::wearer_view(const FrameBundle& bundle,
                                                         const std::vector<Sighting>& sightings,
                                                         FrameEstimate& estimate) const {
  estimate.pseudo_stereo_outcome =
      bundle.wearer_pose_missing ? PseudoStereoOutcome::kNoWearerPose : PseudoStereoOutcome::kNoWearerImage;
  if (!bundle.image || !bundle.wearer || !may_use_wearer(bundle.stamp)) return std::nullopt;
  estimate.pseudo_stereo_outcome = PseudoStereoOutcome::kNotDue;
  if (!is_wearer_due(bundle.stamp)) return std::nullopt;
  // An orientation from the AHRS is one in W: it needs the robot's own, better than the motion model knows
  // it.
  const auto T_WS = bundle.wearer->has_orientation
                        ? std::nullopt
                        : pose_of_sightings(filter_, sightings, pose_covariance_, options_.seed);
  const auto T_SF =
      wearer_pose(*bundle.wearer, T_WS.value_or(filter_.T_WS()), yaw_offset_.yaw_WA(bundle.stamp));
  estimate.pseudo_stereo_outcome = PseudoStereoOutcome::kNoWearerPose;
  if (!T_SF) return std::nullopt;
  estimate.overlap =
      overlap::predict_overlap(filter_.camera_model(), bundle.wearer->camera, *T_SF, options_.overlap);
  estimate.pseudo_stereo_outcome = PseudoStereoOutcome::kNoOverlap;
  if (!estimate.overlap.predicted) return std::nullopt;
  StereoView view;
  view.image_F = bundle.wearer->image.get();
  view.rig = {filter_.camera_model(), bundle.wearer->camera, *T_SF, options_.search.pixel_sigma,
              options_.pseudo_stereo.wearer_pixel_sigma};
  view.T_SF_sensed = *T_SF;
  view.overlap = estimate.overlap;
  view.near = std::max(options_.pseudo_stereo.near, expected_near(search_.predictions()));
  view.up_S = filter_.camera().q_WS.conjugate() * Eigen::Vector3d::UnitZ();
  view.silhouette = silhouette_;
  return view;
}

void CollaborativeSlam::learn_yaw_offset(const WearerView& wearer, const StereoView& view) {
  if (wearer.has_orientation || !wearer.q_WF) return;
  const auto yaw = yaw_by_matches(view.T_SF_sensed, view.rig.T_SF, filter_.camera().q_WS.toRotationMatrix());
  if (!yaw) return;
  const Eigen::Quaterniond turn(
      Eigen::AngleAxisd(yaw_offset_.yaw_WA(wearer.stamp).angle + yaw->angle, Eigen::Vector3d::UnitZ()));
  const Eigen::Matrix3d covariance = Eigen::Vector3d(0.0, 0.0, yaw->sigma * yaw->sigma).asDiagonal();
  yaw_offset_.sighting(wearer.stamp, turn * *wearer.q_WF, covariance, *wearer.q_WF);
}

std::vector<ekf::Measurement> CollaborativeSlam::validate(const std::vector<ekf::Measurement>& measurements,
                                                          const ekf::StereoRig* wearer,
                                                          FrameEstimate& estimate) {
  const auto refuse = [&](const ekf::Measurement& measurement, int SearchCounts::*pixels,
                          int PseudoStereoCounts::*worn) {
    if (measurement.kind != ekf::MeasurementKind::kPixel) ++(estimate.pseudo_stereo.*worn);
    if (measurement.kind == ekf::MeasurementKind::kWearerPixel) return;
    ++(estimate.search.*pixels);
    if (LandmarkTrack* track = tracks_.find(measurement.landmark)) ++track->failures;
  };
  const ekf::ChiSquaredLimits limits(options_.search.gate_probability, 3);
  const bool is_lonely = static_cast<int>(measurements.size()) < options_.search.min_agreeing;
  std::vector<ekf::Measurement> gated;
  for (const ekf::LinearisedMeasurement& linearised :
       filter_.innovation(measurements, wearer).measurements()) {
    const ekf::Measurement& measurement = measurements[static_cast<std::size_t>(linearised.measurement)];
    const bool is_far = is_lonely && measurement.kind != ekf::MeasurementKind::kPoint &&
                        linearised.innovation.head<2>().norm() > options_.search.max_lonely_px;
    if (linearised.nis <= limits(linearised.rows) && !is_far) {
      gated.push_back(measurement);
    } else {
      refuse(measurement, &SearchCounts::chi_squared, &PseudoStereoCounts::chi_squared);
    }
  }
  const ekf::JointInnovation& joint = filter_.innovation(gated, wearer);
  const ekf::Hypothesis& hypothesis = compatibility_.test(joint);
  std::vector<ekf::Measurement> accepted;
  for (std::size_t i = 0; i < hypothesis.keep.size(); ++i) {
    const ekf::Measurement& measurement =
        gated[static_cast<std::size_t>(joint.measurements()[i].measurement)];
    if (hypothesis.keep[i] != 0) {
      accepted.push_back(measurement);
    } else {
      refuse(measurement, &SearchCounts::joint_compatibility, &PseudoStereoCounts::joint_compatibility);
    }
  }
  return accepted;
}

void CollaborativeSlam::note_fused(const std::vector<Sighting>& sightings, const ekf::UpdateReport& report,
                                   FrameEstimate& estimate) {
  for (LandmarkTrack& track : tracks_.all())
    track.found = false;
  double squared_px = 0.0;
  for (const ekf::MeasurementReport& measurement : report.measurements) {
    LandmarkTrack* track = tracks_.find(measurement.landmark);
    if (track == nullptr || measurement.outcome != ekf::Outcome::kFused) continue;
    if (measurement.kind != ekf::MeasurementKind::kPixel) ++estimate.pseudo_stereo.fused;
    if (measurement.kind == ekf::MeasurementKind::kWearerPixel) continue;
    track->found = true;
    ++track->observations;
    if (measurement.kind == ekf::MeasurementKind::kPixel) {
      ++estimate.search.fused_pixels;
      squared_px += measurement.innovation.head<2>().squaredNorm();
    }
  }
  for (const Sighting& sighting : sightings) {
    LandmarkTrack* track = tracks_.find(sighting.landmark);
    if (track != nullptr && track->found) track->pixel = sighting.pixel;
  }
  if (estimate.search.fused_pixels > 0) {
    estimate.innovation_rms_px = std::sqrt(squared_px / estimate.search.fused_pixels);
  }
  if (report.rows > 0) estimate.nis_per_dof = report.nis / report.rows;
}

void CollaborativeSlam::renew_map(const GrayImage& image, const std::optional<StereoView>& view,
                                  const WornMatches& matches, FrameEstimate& estimate, Stopwatch& watch) {
  if (!has_map_) {
    begin(image, view, estimate);
    watch.lap(estimate.timings.pseudo_stereo);
    return;
  }
  estimate.landmarks_removed = maintenance_.tidy(filter_, tracks_);
  filter_.convert_linear_landmarks(options_.map.max_point_nonlinearity);
  renew_references(image);
  watch.lap(estimate.timings.map);
  if (view) {
    const int places = maintenance_.make_room(filter_, tracks_, options_.pseudo_stereo.max_new_landmarks);
    estimate.landmarks_added += add_pseudo_stereo(
        image, *view, matches, {places, options_.pseudo_stereo.max_new_tries}, estimate.pseudo_stereo);
  }
  watch.lap(estimate.timings.pseudo_stereo);
  candidates_.track(tracker_, filter_, usual_depth(search_.predict(filter_, tracks_)), silhouette_);
  maintenance_.make_room(filter_, tracks_, candidates_.size());
  estimate.landmarks_added +=
      candidates_.initialise(filter_, tracks_, options_.map.max_landmarks, options_.map.min_distance_px);
  const int in_view = static_cast<int>(tracks_.found_pixels().size());
  candidates_.detect(image, filter_, corners_, tracks_.found_pixels(), silhouette_,
                     options_.map.max_landmarks - in_view);
  watch.lap(estimate.timings.map);
}

void CollaborativeSlam::begin(const GrayImage& image, const std::optional<StereoView>& view,
                              FrameEstimate& estimate) {
  if (!known_points_.empty() && resets_ == 0) {
    has_map_ = start_from_known_points(known_points_, image, options_, filter_, tracks_);
  } else if (options_.start.assumed_depth > 0.0) {
    has_map_ =
        start_at_assumed_depth(options_.start.assumed_depth, image, corners_, options_, filter_, tracks_);
  }
  if (!has_map_ && view) has_map_ = start_from_view(image, *view, estimate);
  if (!has_map_ && resets_ > 0)
    has_map_ = start_at_assumed_depth(depth_before_reset_, image, corners_, options_, filter_, tracks_);
  if (!has_map_) return;
  if (!scale_stamp_) scale_stamp_ = estimate.stamp;
  health_.restart(estimate.stamp);
}

bool CollaborativeSlam::start_from_view(const GrayImage& image, const StereoView& view,
                                        FrameEstimate& estimate) {
  estimate.landmarks_added =
      add_pseudo_stereo(image, view, {}, {options_.start.first_landmarks, 2 * options_.start.first_landmarks},
                        estimate.pseudo_stereo);
  if (is_good_start(estimate.stamp)) return true;
  forget_landmarks();
  estimate.pseudo_stereo.redundant += std::exchange(estimate.pseudo_stereo.initialised, 0);
  estimate.landmarks_added = 0;
  return false;
}

void CollaborativeSlam::forget_landmarks() {
  for (const LandmarkTrack& track : tracks_.all())
    filter_.remove_landmark(track.id);
  tracks_.clear();
}

// The map of a lost filter is wrong where it matters; what it was before stays in the archive. The new one
// begins where the motion model leads, with the doubt that has grown on the way.
void CollaborativeSlam::leave_map(Stamp stamp) {
  ++resets_;
  candidates_.clear(filter_);
  forget_landmarks();
  filter_.predict(to_seconds(stamp - last_stamp_.value_or(stamp)));
  const UncertainPose T_WS = filter_.T_WS();
  filter_.reset(T_WS, options_.motion.start_sigma_velocity, options_.motion.start_sigma_angular_velocity);
  search_.predict(filter_, tracks_);
  first_view_stamp_.reset();
  has_map_ = false;
}

bool CollaborativeSlam::is_good_start(Stamp stamp) const {
  const StartOptions& start = options_.start;
  const bool is_late = first_view_stamp_ && to_seconds(stamp - *first_view_stamp_) >= start.patience_s;
  return filter_.landmark_count() >= (is_late ? start.min_landmarks_later : start.min_landmarks);
}

int CollaborativeSlam::add_pseudo_stereo(const GrayImage& image, const StereoView& view,
                                         const WornMatches& matches, const NewPoints::Budget& budget,
                                         PseudoStereoCounts& counts) {
  const auto points =
      wearer_matcher_.new_points(view, image, matches, tracks_.found_pixels(), budget, counts);
  const bool as_state =
      options_.pseudo_stereo.pose_error_is_state;  // the matches correct the sensors' pose once
  return start_landmarks(points, as_state ? view.sensed_rig() : view.rig, image,
                         as_state || options_.pseudo_stereo.correlated_starts, filter_, tracks_, counts);
}

void CollaborativeSlam::renew_references(const GrayImage& image) {
  const Pose T_WS = filter_.camera().T_WS();
  for (LandmarkTrack& track : tracks_.all()) {
    const auto landmark = track.found ? filter_.landmark(track.id) : std::nullopt;
    if (!landmark) continue;
    const auto A = vision::predicted_warp({filter_.camera_model(), track.T_WS_reference},
                                          {filter_.camera_model(), T_WS}, finite_point(*landmark));
    constexpr double kMaxMagnification = 1.7;  // beyond it the old patch has no detail left to correlate
    if (A && A->determinant() < kMaxMagnification * kMaxMagnification) continue;
    track.reference = vision::cut_reference(image, track.pixel);
    track.T_WS_reference = T_WS;
  }
}

Tracking CollaborativeSlam::judge(const FrameEstimate& estimate) {
  if (!has_map_) return resets_ > 0 ? Tracking::kLost : Tracking::kWaitingForScale;
  health_.note(estimate.stamp, estimate.search, estimate.pseudo_stereo);
  if (health_.is_sure()) depth_before_reset_ = usual_depth(search_.predictions());
  return health_.is_lost() ? Tracking::kLost : Tracking::kTracking;
}

void CollaborativeSlam::describe(FrameEstimate& estimate) {
  estimate.tracking = judge(estimate);
  estimate.test_ratio = health_.test_ratio();
  estimate.resets = resets_;
  estimate.T_WS = filter_.T_WS();
  pose_covariance_ = estimate.T_WS.covariance;
  const ekf::CameraState camera = filter_.camera();
  estimate.v_W = camera.v_W;
  estimate.omega_S = camera.omega_S;
  estimate.twist_covariance = filter_.twist_covariance();
  estimate.landmarks = filter_.landmark_count();
  estimate.candidates = candidates_.size();
  const wearer::UncertainAngle yaw = yaw_offset_.yaw_WA(estimate.stamp);
  estimate.yaw_offset = yaw.angle;
  estimate.yaw_offset_sigma = yaw.sigma;
  if (estimate.overlap.predicted) estimate.pseudo_stereo_outcome = outcome_of(estimate.pseudo_stereo);
}

}  // namespace cosight::slam
