#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/patch.hpp"
#include "robot_agent/vision/point_tracker.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::slam {

/// A feature that waits for parallax (equations section 4): the pose at which it was first seen, its first
/// pixel, and its patch.
struct Candidate {
  ekf::FirstSighting first;
  std::optional<ekf::CloneId> clone;  ///< the first pose as a block of the state, when it is kept there
  vision::ReferencePatch reference;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the present frame [px]
  int age = 0;                                      ///< frames since the first sighting
};

/// Candidates from their first sighting to their start in the filter.
class CandidatePool {
 public:
  explicit CandidatePool(const CandidateOptions& options, double pixel_sigma);

  /// Follows every candidate into the present frame; `depth` [m] is what is assumed of points without one.
  void track(const vision::PointTracker& tracker, const ekf::Filter& filter, double depth,
             const ConvexPolygon& hidden);

  /// Starts those that have parallax (DI-D), at most until the filter has `max_landmarks`. Returns how many.
  int initialise(ekf::Filter& filter, LandmarkTracks& tracks, int max_landmarks, int min_distance_px);

  /// Every `keyframe_interval` frames: new candidates where the image shows neither landmark nor candidate,
  /// nor what `hidden` covers.
  void detect(const GrayImage& image, ekf::Filter& filter, const vision::CornerDetector& detector,
              std::vector<Eigen::Vector2d> occupied, const ConvexPolygon& hidden, int wanted);

  void clear(ekf::Filter& filter);
  int size() const { return static_cast<int>(candidates_.size()); }
  const std::vector<Candidate>& all() const { return candidates_; }

 private:
  bool has_parallax(const Candidate& candidate, const ekf::Filter& filter) const;
  std::optional<ekf::LandmarkId> start(const Candidate& candidate, ekf::Filter& filter) const;
  void drop_unused_clones(ekf::Filter& filter);

  CandidateOptions options_;
  double pixel_sigma_;
  std::vector<Candidate> candidates_;
  std::vector<ekf::CloneId> clones_;
  int frames_since_detection_ = 1'000'000;  ///< detect at the first opportunity
};

}  // namespace cosight::slam
