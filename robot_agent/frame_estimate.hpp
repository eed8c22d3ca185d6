#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight {

/// Why a frame with a worn image gave no pseudo-stereo match, or the last stage at which any was left.
enum class PseudoStereoOutcome {
  kMatched,             ///< at least one was fused or started a landmark
  kNotDue,              ///< the last worn frame was used a moment ago
  kNoWearerImage,       ///< no worn frame near enough in time
  kNoWearerPose,        ///< no pose of Cf in Cs, or one without any orientation
  kNoOverlap,           ///< the two fields of view do not intersect
  kNoFeaturesInRoi,     ///< nothing to describe inside the overlap
  kRatioTest,           ///< every descriptor match was ambiguous, or not mutual, or correlated too weakly
  kEpipolar,            ///< every match lay outside the epipolar band, or behind a camera
  kTooLittleParallax,   ///< every match was too far away to give depth
  kChiSquared,          ///< every one failed its own innovation gate
  kJointCompatibility,  ///< every one was removed by HOHCT
};
const char* to_string(PseudoStereoOutcome outcome);

/// How many of Cf's matches fell at each stage of one frame. `described` = the sum of all others.
struct PseudoStereoCounts {
  int described = 0;  ///< features with a descriptor or patch inside the ROI
  int ratio_test = 0;
  int epipolar = 0;
  int too_little_parallax = 0;
  int chi_squared = 0;
  int joint_compatibility = 0;
  int fused = 0;        ///< of mapped landmarks, measured as a pixel of Cf or a point (C5)
  int initialised = 0;  ///< started a new landmark at once
  int redundant = 0;    ///< good, but the map needed no more there
};

/// How many of the landmarks in view fell at each stage of one frame's active search.
struct SearchCounts {
  int predicted_in_view = 0;
  int searched = 0;
  int not_found = 0;            ///< no place in the ellipse correlates well enough
  int chi_squared = 0;          ///< found, but outside its own gate
  int joint_compatibility = 0;  ///< removed by HOHCT
  int fused_pixels = 0;         ///< measured as a bearing (C6)
};

/// The distance of a point of the frame, as the wearer's view of the same moment alone tells it (C
/// section 3.2).
struct StereoDepth {
  Eigen::Vector2d pixel_S = Eigen::Vector2d::Zero();  ///< [px]
  double inverse_distance = 0.0;                      ///< from Cs [1/m]
  double sigma = 0.0;                                 ///< by the noise of its pixels alone [1/m]
  double shared_sigma = 0.0;  ///< by the pose of Cf, whose error all points of the frame share [1/m]
};

/// Wall time of the stages of one frame [ms].
struct StageTimings {
  double decode = 0.0;
  double predict = 0.0;
  double search = 0.0;
  double overlap = 0.0;
  double pseudo_stereo = 0.0;
  double validate = 0.0;
  double update = 0.0;
  double map = 0.0;
  double total = 0.0;
};

/// The part of the fields of view that both cameras share. Polygons in pixels, counter-clockwise or empty.
struct OverlapEstimate {
  bool predicted = false;
  double far_depth = 0.0;  ///< where the frustums were cut [m]
  std::vector<Eigen::Vector2d> roi_in_S;
  std::vector<Eigen::Vector2d> roi_in_F;
};

/// Whether the estimate can be used.
enum class Tracking { kWaitingForScale, kTracking, kLost };
const char* to_string(Tracking tracking);

/// What one frame did. The estimates and counts are a pure function of the bundles; the timings are not.
struct FrameEstimate {
  Stamp stamp = 0;
  std::uint64_t sequence = 0;
  Tracking tracking = Tracking::kWaitingForScale;
  UncertainPose T_WS;
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();                                       ///< [m/s]
  Eigen::Vector3d omega_S = Eigen::Vector3d::Zero();                                   ///< [rad/s]
  Eigen::Matrix<double, 6, 6> twist_covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of [v_W, omega_S]

  PseudoStereoOutcome pseudo_stereo_outcome = PseudoStereoOutcome::kNoWearerImage;
  PseudoStereoCounts pseudo_stereo;
  SearchCounts search;
  OverlapEstimate overlap;
  std::vector<StereoDepth> stereo_depths;  ///< of the matches that were fused
  int landmarks = 0;
  int candidates = 0;
  int landmarks_added = 0;
  int landmarks_removed = 0;
  double innovation_rms_px = 0.0;  ///< of the fused bearings
  double nis_per_dof = 0.0;        ///< of everything fused; about 1 when the filter is consistent
  double test_ratio = 1.0;         ///< share of the landmarks looked for that were found and believed lately
  int resets = 0;                  ///< how often a lost filter began a new map
  double yaw_offset = 0.0;         ///< of the AHRS's north against W, beyond what is configured [rad]
  double yaw_offset_sigma = 0.0;   ///< [rad]
  StageTimings timings;
};

/// A landmark as others see it.
struct MapPoint {
  std::uint64_t id = 0;
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();         ///< [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< [m^2], first order
  std::uint8_t intensity = 0;                            ///< of the patch's centre
  int observations = 0;
  bool in_filter = true;  ///< false: left the filter's budget, kept for the map on disk
};

}  // namespace cosight
