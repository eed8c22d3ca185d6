#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot_agent/ekf/measurement.hpp"
#include "robot_agent/vision/patch.hpp"
#include "shared/geometry/pose.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::slam {

/// What the images know of a landmark; where it is, the filter knows.
struct LandmarkTrack {
  ekf::LandmarkId id = 0;
  vision::ReferencePatch reference;
  Pose T_WS_reference;                              ///< of the SLAM camera when the reference patch was cut
  std::optional<Eigen::Vector3d> normal_W;          ///< of its surface, once two views have shown it
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< where Cs saw it last [px]
  bool found = false;                               ///< in the present frame
  int observations = 1;                             ///< frames in which it was fused
  int attempts = 0;                                 ///< frames in which it was looked for
  int failures = 0;                                 ///< of these, not found or refused
  int frames_unseen = 0;                            ///< since it was fused last
};

/// The track of a landmark that starts in this image, seen at `pixel` from T_WS.
LandmarkTrack track_from(const GrayImage& image, ekf::LandmarkId id, const Eigen::Vector2d& pixel,
                         const Pose& T_WS);

/// One track a landmark of the filter, oldest first: the filter's order.
class LandmarkTracks {
 public:
  void add(LandmarkTrack track) { tracks_.push_back(std::move(track)); }
  void remove(ekf::LandmarkId id);
  void clear() { tracks_.clear(); }

  /// Null when there is none.
  LandmarkTrack* find(ekf::LandmarkId id);

  std::vector<LandmarkTrack>& all() { return tracks_; }
  const std::vector<LandmarkTrack>& all() const { return tracks_; }

  /// Pixels of the landmarks that the present frame shows: where no other feature is wanted.
  std::vector<Eigen::Vector2d> found_pixels() const;

 private:
  std::vector<LandmarkTrack> tracks_;
};

}  // namespace cosight::slam
