#pragma once

#include <functional>
#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/ekf/joint_compatibility.hpp"
#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/map/map_archive.hpp"
#include "robot_agent/slam/candidate_pool.hpp"
#include "robot_agent/slam/health.hpp"
#include "robot_agent/slam/known_start.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/map_maintenance.hpp"
#include "robot_agent/slam/motion_prior.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/slam/stopwatch.hpp"
#include "robot_agent/slam/wearer_matcher.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/point_tracker.hpp"
#include "robot_agent/wearer/yaw_offset.hpp"

namespace cosight::slam {

/// Collaborative DI-D EKF SLAM (the paper's Figure 4): a pure function of the sequence of bundles. The same
/// bundles give the same estimates.
class CollaborativeSlam {
 public:
  /// Time for the stage timings [ns]; never enters an estimate. None: the timings stay zero.
  using WallClock = std::function<Stamp()>;

  /// `known_points`: surveyed points in the first image, or none; then the first overlap gives the scale.
  CollaborativeSlam(const CameraModel& camera_S, const SlamOptions& options,
                    std::vector<KnownPoint> known_points = {}, WallClock clock = {});

  FrameEstimate process(const FrameBundle& bundle);

  const ekf::Filter& filter() const { return filter_; }
  /// Landmarks of the filter and those that left it.
  std::vector<MapPoint> map() const { return maintenance_.map(); }

 private:
  void see_wearer(const FrameBundle& bundle);
  bool advance_to(const FrameBundle& bundle);
  bool is_wide(const std::vector<ekf::PixelPrediction>& predictions) const;
  bool may_use_wearer(Stamp stamp) const;
  bool is_wearer_due(Stamp stamp) const;
  bool is_good_start(Stamp stamp) const;
  std::optional<StereoView> wearer_view(const FrameBundle& bundle, const std::vector<Sighting>& sightings,
                                        FrameEstimate& estimate) const;
  void learn_yaw_offset(const WearerView& wearer, const StereoView& view);
  std::vector<ekf::Measurement> validate(const std::vector<ekf::Measurement>& measurements,
                                         const ekf::StereoRig* wearer, FrameEstimate& estimate);
  void note_fused(const std::vector<Sighting>& sightings, const ekf::UpdateReport& report,
                  FrameEstimate& estimate);
  void renew_map(const GrayImage& image, const std::optional<StereoView>& view, const WornMatches& matches,
                 FrameEstimate& estimate, Stopwatch& watch);
  void begin(const GrayImage& image, const std::optional<StereoView>& view, FrameEstimate& estimate);
  bool start_from_view(const GrayImage& image, const StereoView& view, FrameEstimate& estimate);
  void forget_landmarks();
  void leave_map(Stamp stamp);
  int add_pseudo_stereo(const GrayImage& image, const StereoView& view, const WornMatches& matches,
                        const NewPoints::Budget& budget, PseudoStereoCounts& counts);
  void renew_references(const GrayImage& image);
  Tracking judge(const FrameEstimate& estimate);
  void describe(FrameEstimate& estimate);

  SlamOptions options_;
  std::vector<KnownPoint> known_points_;
  WallClock clock_;

  ekf::Filter filter_;
  ekf::JointCompatibility compatibility_;
  LandmarkTracks tracks_;
  LandmarkSearch search_;
  CandidatePool candidates_;
  WearerMatcher wearer_matcher_;
  wearer::YawOffset yaw_offset_;
  MapMaintenance maintenance_;
  MotionPrior motion_prior_;
  vision::PointTracker tracker_;
  vision::CornerDetector corners_;

  Eigen::Matrix<double, 6, 6> pose_covariance_ =
      Eigen::Matrix<double, 6, 6>::Zero();  ///< after the last frame
  ConvexPolygon silhouette_;                ///< of the wearer in the present frame [px]
  std::optional<Stamp> last_stamp_;
  std::optional<Stamp> scale_stamp_;       ///< when tracking began
  std::optional<Stamp> first_view_stamp_;  ///< when the views overlapped first
  std::optional<Stamp> view_stamp_;        ///< of the last frame whose overlap with Cf was measured

  bool has_map_ = false;
  Health health_;
  int resets_ = 0;
  double depth_before_reset_ = 0.0;  ///< usual in view when the filter was sure last [m]
};

}  // namespace cosight::slam
