#pragma once

#include <memory>
#include <vector>

#include "robot_agent/vins/window.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vins {

struct FeatureTrackerOptions {
  int max_features = 150;             ///< in one frame
  double min_distance = 20.0;         ///< [px] between features
  double min_score = 20.0;            ///< Shi-Tomasi's, [(gray levels / px)^2]; lower for dim images
  double max_forward_backward = 0.5;  ///< [px] after tracking there and back
};

/// The front end: Shi-Tomasi corners, spread evenly, followed by pyramidal Lucas-Kanade with a
/// forward-backward check, handed on as points of the undistorted image plane.
class FeatureTracker {
 public:
  FeatureTracker(const CameraModel& camera, const FeatureTrackerOptions& options);
  FeatureTracker(const FeatureTracker&) = delete;
  FeatureTracker& operator=(const FeatureTracker&) = delete;
  ~FeatureTracker();

  /// The features of the next image; those seen before keep their ids.
  FeatureFrame track(Stamp stamp, const GrayImage& image);

 private:
  struct Tools;
  struct Feature {
    FeatureId id;
    Eigen::Vector2d pixel;
    Eigen::Vector2d point;  ///< undistorted [x/z, y/z]
  };

  void follow();
  void replenish(const GrayImage& image);

  CameraModel camera_;
  FeatureTrackerOptions options_;
  std::unique_ptr<Tools> tools_;
  std::vector<Feature> features_;
  FeatureId next_id_ = 0;
};

}  // namespace cosight::vins
