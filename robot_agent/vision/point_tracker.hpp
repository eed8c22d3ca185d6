#pragma once

#include <Eigen/Core>
#include <memory>
#include <vector>

#include "robot_agent/vision/patch.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

struct TrackerOptions {
  int window = 13;                    ///< [px] side; larger for blurred images, smaller for close texture
  int levels = 4;                     ///< of the pyramid; each doubles the motion that can be followed
  double max_forward_backward = 1.0;  ///< [px] tracked there and back, at most this far from the start
  double min_score = 0.7;             ///< ZNCC with the first patch; -1 lets everything pass
};

enum class TrackOutcome {
  kTracked,
  kLost,          ///< no convergence, or no texture
  kOutsideImage,  ///< tracked to where the patch does not lie in the image
  kInconsistent,  ///< does not lead back to the start
  kChanged,       ///< does not look like the first patch any more
};

struct TrackStart {
  Eigen::Vector2d previous = Eigen::Vector2d::Zero();   ///< pixel in the previous frame
  Eigen::Vector2d predicted = Eigen::Vector2d::Zero();  ///< where to begin in the present frame
  const Patch* first = nullptr;                         ///< as it should look now; null: no check
};

struct Track {
  TrackOutcome outcome = TrackOutcome::kLost;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
  double score = 0.0;  ///< ZNCC with the first patch, where it was checked

  explicit operator bool() const { return outcome == TrackOutcome::kTracked; }
};

/// Pyramidal Lucas-Kanade from frame to frame. Each frame's pyramid is built once and serves as the present
/// one and then as the previous one.
class PointTracker {
 public:
  explicit PointTracker(const TrackerOptions& options = {});
  PointTracker(const PointTracker&) = delete;
  PointTracker& operator=(const PointTracker&) = delete;
  ~PointTracker();

  /// The present frame becomes the previous one. Call it for every frame, also for those without points.
  void advance(const GrayImage& image);

  /// One track a start, in their order; all lost when there are not yet two frames of one size.
  std::vector<Track> track(const std::vector<TrackStart>& starts) const;

 private:
  struct Pyramids;
  TrackerOptions options_;
  std::unique_ptr<Pyramids> pyramids_;
};

}  // namespace cosight::vision
