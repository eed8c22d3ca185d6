#pragma once

#include <cstdint>

#include "robot_agent/overlap/predict_overlap.hpp"
#include "robot_agent/slam/measurement_budget.hpp"
#include "robot_agent/wearer/yaw_offset.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::slam {

/// Which camera's measurements the filter may use.
enum class Mode {
  kCollaborative,  ///< Cs and Cf
  kMono,           ///< Cs alone once the scale is set (`StartOptions::overlap_s`)
};

/// Where a candidate's first camera pose is kept until it has parallax (equations section 4).
enum class FirstPose {
  kStored,  ///< beside the filter, as if independent of the present pose (C8)
  kCloned,  ///< as a block of the state: consistent, seven states a keyframe
};

/// What a mapped landmark's match in Cf measures.
enum class WornMeasurement {
  kPixel,  ///< a second pixel, in Cf (ekf::WearerObservation)
  kPoint,  ///< a 3-D point in Cs (C5), triangulated: the paper's way
};

/// How new points are found in Cf. Known landmarks are found by ZNCC inside their epipolar band in any case.
enum class Matching {
  kBand,  ///< corners of Cs by ZNCC along their epipolar band: the cheapest, for views that are not too
          ///< different
  kOrb,
  kSift,
  kSurf,
};

/// Constant velocity with unknown accelerations. Larger when the camera moves abruptly, smaller when it
/// drifts.
struct MotionOptions {
  double sigma_acceleration = 1.5;            ///< [m/s^2]
  double sigma_angular_acceleration = 2.0;    ///< [rad/s^2]
  double start_sigma_velocity = 1.0;          ///< before anything was seen to move [m/s]
  double start_sigma_angular_velocity = 1.0;  ///< [rad/s]
};

/// Active search for landmarks in Cs.
struct SearchOptions {
  double pixel_sigma = 0.5;        ///< noise of a found pixel, one axis [px]
  double gate_probability = 0.99;  ///< of the ellipse and of HOHCT's chi-squared limit
  double each_probability = 0.99;  ///< of a match given all others, after HOHCT; 1 switches that off
  double min_correlation = 0.75;   ///< ZNCC of a match
  double max_ambiguity = 0.95;     ///< second best peak / best; above it the place is ambiguous
  int max_radius = 40;             ///< an ellipse is cut to this half-width [px]
  double wide_prior_px = 12.0;  ///< predicted sigma above which the motion is looked for in the images first
  int max_iterations = 1;       ///< of one update (Gauss-Newton); more where the prior is wide
  /// Fewer pixels, of both cameras together, cannot check one another: one that is farther from its
  /// prediction than `max_lonely_px` is refused.
  int min_agreeing = 4;
  double max_lonely_px = 4.0;
  int max_measured = 60;  ///< landmarks measured a frame, the most informative first
  BudgetOptions budget;   ///< of time, for whoever needs a bound on the worst frame
};

/// Depth from the wearer's camera.
struct PseudoStereoOptions {
  Matching matching = Matching::kBand;
  int max_features = 500;                  ///< described in each image
  double max_ratio = 0.85;                 ///< best / second best descriptor distance
  double min_correlation = 0.8;            ///< ZNCC between the two views
  double wearer_pixel_sigma = 0.5;         ///< noise of a pixel in Cf, one axis [px]
  double min_parallax_deg = 1.0;           ///< below it there is no depth in the pair
  double max_relative_depth_sigma = 0.25;  ///< sigma_rho / rho above which a pair says too little
  double near = 0.3;                       ///< nothing nearer is looked for [m]
  double max_ambiguity = 0.9;              ///< second best peak / best along the band
  double band_sigmas = 3.0;                ///< half-width of the epipolar band in sigmas of the pose
  int max_band_radius = 80;                ///< the band is cut to this half-width around the prediction [px]
  /// Between two worn frames that are used, once the map has begun [s]. What the sensors get wrong of Cf's
  /// pose hardly changes in less, so that more frames cost time and tell nothing new.
  double interval_s = 0.25;
  /// The points of a frame share the error of Cf's pose: measured with it (off-diagonal blocks of R), or as
  /// if independent (the paper).
  bool correlated_updates = true;
  WornMeasurement measure_as = WornMeasurement::kPixel;
  /// The same for the landmarks that start in one frame. Off: a scale that hangs on one uncertain pose alone
  /// is the direction in which an EKF drifts (docs/decisions/0005).
  bool correlated_starts = false;
  /// The error of Cf's pose in the filter's state: measured pixels and new landmarks correct it and share it,
  /// whatever the two options above say. Off: noise.
  bool pose_error_is_state = false;
  double pose_error_time_s = 0.0;  ///< its correlation time as a state [s]; 0: new in every frame
  int max_new_landmarks = 12;      ///< started from one frame
  int max_new_tries = 6;           ///< corners tried for them in a frame: the budget of time
  /// The pose of Cf is estimated from the matches as well, the sensors' pose being the prior; off: it is
  /// taken as the sensors give it (the paper).
  bool refine_wearer_pose = true;
  int min_refining_matches = 6;  ///< of known landmarks; with fewer, new corners help
};

/// The wearer's body, as it hides the scene from the robot.
struct BodyOptions {
  double radius = 0.45;  ///< around the worn camera, arms included [m]; 0: nobody wears it (a second robot)
  double above_eyes = 0.25;   ///< [m]
  double below_eyes = 1.75;   ///< [m]
  double min_distance = 0.6;  ///< nearer than this it is not a body in front of the camera [m]
};

/// Features that wait for parallax.
struct CandidateOptions {
  int max_candidates = 40;
  double min_parallax_deg = 1.0;  ///< alpha_min
  double min_baseline_m = 0.03;   ///< b_min
  double max_relative_depth_sigma = 0.5;
  int max_age_frames = 60;  ///< without parallax after so many frames it gives its place to another
  FirstPose first_pose = FirstPose::kCloned;
  int keyframe_interval = 5;  ///< frames between detections, and so between cloned poses
};

/// What the filter keeps.
struct MapOptions {
  int max_landmarks = 60;
  int min_distance_px = 25;       ///< between two landmarks in the image: spread
  int forget_after_frames = 15;   ///< out of view for so long, a landmark leaves the filter for the map
  double max_failed_ratio = 0.5;  ///< failed / attempted searches above which a landmark goes
  int min_attempts = 4;           ///< searches before that ratio counts
  /// Linearity index (Civera) below which a landmark is kept as a point, three states instead of six; 0:
  /// never. 0.1 is usual.
  double max_point_nonlinearity = 0.0;
};

/// How the estimate gets its origin and its scale.
struct StartOptions {
  /// Where the camera starts. The default looks along x of W, level.
  Pose T_WS{Eigen::Quaterniond(0.5, -0.5, 0.5, -0.5), Eigen::Vector3d::Zero()};
  double sigma_position = 1e-3;  ///< of that pose [m]
  double sigma_rotation = 1e-3;  ///< [rad]
  int first_landmarks = 40;      ///< pseudo-stereo landmarks wanted from the first overlap
  int min_landmarks = 12;        ///< pseudo-stereo landmarks that make a first overlap good enough
  int min_landmarks_later = 6;   ///< the same once the views have overlapped for `patience_s` in vain
  double patience_s = 1.0;       ///< few landmarks hang on one another's errors: a better view may come
  /// Without a wearer and surveyed points: depth of the first landmarks, give or take a half [m]. The scale
  /// of everything is then arbitrary, and drifts. 0: no start without a scale.
  double assumed_depth = 0.0;
  double overlap_s = 0.35;          ///< mono: Cf may set the scale so long, and is not used again
  double known_point_sigma = 1e-3;  ///< of surveyed points [m]
  double known_pixel_sigma = 1.0;   ///< of their pixels in the first frame [px]
};

/// When the filter is lost, and what is done then.
struct HealthOptions {
  double lost_after_s = 0.5;    ///< without any match that holds
  double min_test_ratio = 0.2;  ///< of the landmarks looked for, over `window_s`; below it the map is wrong
  double window_s = 0.3;        ///< [s], the time in which what was seen fades to a third
  /// Lost for so long, slam begins a new map where the motion model leads; 0: never.
  double reset_after_s = 1.0;
};

struct SlamOptions {
  Mode mode = Mode::kCollaborative;
  std::uint32_t seed = 1;  ///< of every random choice (RANSAC)
  MotionOptions motion;
  SearchOptions search;
  PseudoStereoOptions pseudo_stereo;
  BodyOptions body;
  CandidateOptions candidates;
  MapOptions map;
  HealthOptions health;
  StartOptions start;
  /// The AHRS's north against W. A wearer's pose with an orientation of its own does not need it.
  wearer::YawOffsetOptions yaw_offset{.prior = {0.0, 0.035}};
  overlap::OverlapOptions overlap;
};

}  // namespace cosight::slam
