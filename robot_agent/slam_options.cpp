#include "robot_agent/slam_options.hpp"

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

using slam::SlamOptions;

slam::MotionOptions read_motion(const ConfigNode& node) {
  slam::MotionOptions o;
  o.sigma_acceleration = node.number("sigma_acceleration", o.sigma_acceleration, 0.0, 1000.0);
  o.sigma_angular_acceleration =
      node.number("sigma_angular_acceleration", o.sigma_angular_acceleration, 0.0, 1000.0);
  o.start_sigma_velocity = node.number("start_sigma_velocity", o.start_sigma_velocity, 0.0, 1000.0);
  o.start_sigma_angular_velocity =
      node.number("start_sigma_angular_velocity", o.start_sigma_angular_velocity, 0.0, 100.0);
  return o;
}

slam::SearchOptions read_search(const ConfigNode& node) {
  slam::SearchOptions o;
  o.pixel_sigma = node.number("pixel_sigma", o.pixel_sigma, 0.05, 20.0);
  o.gate_probability = node.number("gate_probability", o.gate_probability, 0.5, 0.99999);
  o.each_probability = node.number("each_probability", o.each_probability, 0.5, 1.0);
  o.min_correlation = node.number("min_correlation", o.min_correlation, 0.0, 1.0);
  o.max_ambiguity = node.number("max_ambiguity", o.max_ambiguity, 0.1, 1.0);
  o.max_radius = node.integer("max_radius", o.max_radius, 3, 500);
  o.wide_prior_px = node.number("wide_prior_px", o.wide_prior_px, 1.0, 1000.0);
  o.max_iterations = node.integer("max_iterations", o.max_iterations, 1, 20);
  o.min_agreeing = node.integer("min_agreeing", o.min_agreeing, 0, 500);
  o.max_lonely_px = node.number("max_lonely_px", o.max_lonely_px, 0.0, 1000.0);
  o.max_measured = node.integer("max_measured", o.max_measured, 4, 500);
  o.budget.limit_ms = node.number("budget_ms", o.budget.limit_ms, 0.0, 1000.0);
  o.budget.reserved_ms = node.number("budget_reserved_ms", o.budget.reserved_ms, 0.0, 1000.0);
  return o;
}

slam::PseudoStereoOptions read_pseudo_stereo(const ConfigNode& node) {
  slam::PseudoStereoOptions o;
  o.matching = node.choice("matching", o.matching,
                           {{"band", slam::Matching::kBand},
                            {"orb", slam::Matching::kOrb},
                            {"sift", slam::Matching::kSift},
                            {"surf", slam::Matching::kSurf}});
  o.max_features = node.integer("max_features", o.max_features, 10, 5000);
  o.max_ratio = node.number("max_ratio", o.max_ratio, 0.1, 1.0);
  o.min_correlation = node.number("min_correlation", o.min_correlation, 0.0, 1.0);
  o.wearer_pixel_sigma = node.number("wearer_pixel_sigma", o.wearer_pixel_sigma, 0.05, 20.0);
  o.min_parallax_deg = node.number("min_parallax_deg", o.min_parallax_deg, 0.05, 45.0);
  o.max_relative_depth_sigma = node.number("max_relative_depth_sigma", o.max_relative_depth_sigma, 0.01, 1.0);
  o.near = node.number("near", o.near, 0.01, 1000.0);
  o.max_ambiguity = node.number("max_ambiguity", o.max_ambiguity, 0.1, 1.0);
  o.band_sigmas = node.number("band_sigmas", o.band_sigmas, 0.5, 10.0);
  o.max_band_radius = node.integer("max_band_radius", o.max_band_radius, 3, 1000);
  o.interval_s = node.number("interval_s", o.interval_s, 0.0, 60.0);
  o.measure_as =
      node.choice("measure_as", o.measure_as,
                  {{"pixel", slam::WornMeasurement::kPixel}, {"point", slam::WornMeasurement::kPoint}});
  o.correlated_updates = node.boolean("correlated_updates", o.correlated_updates);
  o.correlated_starts = node.boolean("correlated_starts", o.correlated_starts);
  o.pose_error_is_state = node.boolean("pose_error_is_state", o.pose_error_is_state);
  o.pose_error_time_s = node.number("pose_error_time_s", o.pose_error_time_s, 0.0, 3600.0);
  o.max_new_landmarks = node.integer("max_new_landmarks", o.max_new_landmarks, 0, 500);
  o.max_new_tries = node.integer("max_new_tries", o.max_new_tries, 0, 500);
  o.refine_wearer_pose = node.boolean("refine_wearer_pose", o.refine_wearer_pose);
  o.min_refining_matches = node.integer("min_refining_matches", o.min_refining_matches, 0, 500);
  return o;
}

slam::BodyOptions read_body(const ConfigNode& node) {
  slam::BodyOptions o;
  o.radius = node.number("radius", o.radius, 0.0, 5.0);
  o.above_eyes = node.number("above_eyes", o.above_eyes, 0.0, 5.0);
  o.below_eyes = node.number("below_eyes", o.below_eyes, 0.0, 5.0);
  o.min_distance = node.number("min_distance", o.min_distance, 0.0, 100.0);
  return o;
}

slam::CandidateOptions read_candidates(const ConfigNode& node) {
  slam::CandidateOptions o;
  o.max_candidates = node.integer("max_candidates", o.max_candidates, 0, 500);
  o.min_parallax_deg = node.number("min_parallax_deg", o.min_parallax_deg, 0.05, 45.0);
  o.min_baseline_m = node.number("min_baseline_m", o.min_baseline_m, 0.0, 100.0);
  o.max_relative_depth_sigma =
      node.number("max_relative_depth_sigma", o.max_relative_depth_sigma, 0.01, 10.0);
  o.max_age_frames = node.integer("max_age_frames", o.max_age_frames, 2, 10000);
  o.first_pose = node.choice("first_pose", o.first_pose,
                             {{"stored", slam::FirstPose::kStored}, {"cloned", slam::FirstPose::kCloned}});
  o.keyframe_interval = node.integer("keyframe_interval", o.keyframe_interval, 1, 1000);
  return o;
}

slam::MapOptions read_map(const ConfigNode& node) {
  slam::MapOptions o;
  o.max_landmarks = node.integer("max_landmarks", o.max_landmarks, 10, 500);
  o.min_distance_px = node.integer("min_distance_px", o.min_distance_px, 1, 500);
  o.forget_after_frames = node.integer("forget_after_frames", o.forget_after_frames, 1, 1'000'000);
  o.max_failed_ratio = node.number("max_failed_ratio", o.max_failed_ratio, 0.0, 1.0);
  o.min_attempts = node.integer("min_attempts", o.min_attempts, 1, 1000);
  o.max_point_nonlinearity = node.number("max_point_nonlinearity", o.max_point_nonlinearity, 0.0, 10.0);
  return o;
}

slam::HealthOptions read_health(const ConfigNode& node) {
  slam::HealthOptions o;
  o.lost_after_s = node.number("lost_after_s", o.lost_after_s, 0.05, 1e6);
  o.min_test_ratio = node.number("min_test_ratio", o.min_test_ratio, 0.0, 1.0);
  o.window_s = node.number("window_s", o.window_s, 0.01, 60.0);
  o.reset_after_s = node.number("reset_after_s", o.reset_after_s, 0.0, 1e6);
  return o;
}

slam::StartOptions read_start(const ConfigNode& node) {
  slam::StartOptions o;
  o.T_WS.p = node.vector3("position_W", o.T_WS.p);
  const std::vector<double> q =
      node.numbers("orientation_xyzw", {o.T_WS.q.x(), o.T_WS.q.y(), o.T_WS.q.z(), o.T_WS.q.w()});
  const Eigen::Quaterniond q_WS =
      q.size() == 4 ? Eigen::Quaterniond(q[3], q[0], q[1], q[2]) : Eigen::Quaterniond(0, 0, 0, 0);
  if (std::abs(q_WS.norm() - 1.0) > 1e-3) {
    throw node.error("orientation_xyzw", "needs the four numbers x, y, z, w of a unit quaternion q_WS");
  }
  o.T_WS.q = q_WS.normalized();
  o.sigma_position = node.number("sigma_position", o.sigma_position, 0.0, 100.0);
  o.sigma_rotation = node.number("sigma_rotation", o.sigma_rotation, 0.0, 3.0);
  o.first_landmarks = node.integer("first_landmarks", o.first_landmarks, 4, 500);
  o.min_landmarks_later = node.integer("min_landmarks_later", o.min_landmarks_later, 1, 500);
  o.patience_s = node.number("patience_s", o.patience_s, 0.0, 3600.0);
  o.min_landmarks = node.integer("min_landmarks", o.min_landmarks, 4, 500);
  o.assumed_depth = node.number("assumed_depth", o.assumed_depth, 0.0, 1e6);
  o.overlap_s = node.number("overlap_s", o.overlap_s, 0.0, 1e9);
  o.known_point_sigma = node.number("known_point_sigma", o.known_point_sigma, 0.0, 10.0);
  o.known_pixel_sigma = node.number("known_pixel_sigma", o.known_pixel_sigma, 0.05, 50.0);
  return o;
}

overlap::OverlapOptions read_overlap(const ConfigNode& node) {
  overlap::OverlapOptions o;
  o.near = node.number("near", o.near, 0.01, 1000.0);
  o.far = node.number("far", o.far, 0.1, 10000.0);
  if (o.far <= o.near) throw node.error("far", "must be greater than overlap.near");
  o.min_parallax_deg = node.number("min_parallax_deg", o.min_parallax_deg, 0.01, 45.0);
  o.n_sigmas = node.number("n_sigmas", o.n_sigmas, 0.0, 10.0);
  o.min_area_fraction = node.number("min_area_fraction", o.min_area_fraction, 0.0, 1.0);
  return o;
}

}  // namespace

slam::SlamOptions read_slam_options(const ConfigNode& node) {
  SlamOptions options;
  options.mode = node.choice("mode", options.mode,
                             {{"collaborative", slam::Mode::kCollaborative}, {"mono", slam::Mode::kMono}});
  options.seed = static_cast<std::uint32_t>(node.integer("seed", static_cast<int>(options.seed), 0));
  options.motion = read_motion(node.section("motion"));
  options.search = read_search(node.section("search"));
  options.overlap = read_overlap(node.section("overlap"));
  options.pseudo_stereo = read_pseudo_stereo(node.section("pseudo_stereo"));
  options.body = read_body(node.section("wearer_body"));
  options.candidates = read_candidates(node.section("candidates"));
  options.map = read_map(node.section("map"));
  options.health = read_health(node.section("health"));
  options.start = read_start(node.section("start"));
  return options;
}

}  // namespace cosight
