#pragma once

#include <cstdint>
#include <optional>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/vision/point_tracker.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::slam {

/// The camera's motion from the images themselves, for the frames in which constant velocity says too little:
/// at the start, or after a jerk. Landmarks are followed by Lucas-Kanade from the frame before, and the pose
/// is that of most of them (PnP with RANSAC). It only tells where to search and where to linearise; the
/// filter then weighs the measurements against its own, wide prior.
class MotionPrior {
 public:
  explicit MotionPrior(std::uint32_t seed) : seed_(seed) {}

  /// Pose of the SLAM camera now. Nothing when too few landmarks agree.
  std::optional<Pose> find(const vision::PointTracker& tracker, const ekf::Filter& filter,
                           const LandmarkTracks& tracks) const;

 private:
  std::uint32_t seed_;
};

/// The camera's pose now by what it sees now (PnP with RANSAC): the doubt that the motion model adds is gone,
/// that of W's own axes, `drift` (covariance of the pose before the motion), stays. Nothing when too few
/// sightings agree.
std::optional<UncertainPose> pose_of_sightings(const ekf::Filter& filter,
                                               const std::vector<Sighting>& sightings,
                                               const Eigen::Matrix<double, 6, 6>& drift, std::uint32_t seed);

/// The camera state that moved from `before` to `T_WS` in `dt` [s].
ekf::CameraState moved(const ekf::CameraState& before, const Pose& T_WS, double dt);

}  // namespace cosight::slam
