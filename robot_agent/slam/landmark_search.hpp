#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/vision/active_search.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::slam {

/// A landmark that was found in the SLAM camera's image.
struct Sighting {
  ekf::LandmarkId landmark = 0;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();
};

/// Active search (equations section 7): each landmark's patch, warped to the predicted view, is looked for
/// inside the ellipse of its innovation covariance.
class LandmarkSearch {
 public:
  explicit LandmarkSearch(const SearchOptions& options);

  /// Landmarks predicted inside the image, the least certain first: they tell most.
  const std::vector<ekf::PixelPrediction>& predict(const ekf::Filter& filter, const LandmarkTracks& tracks);

  /// Of the last `predict`.
  const std::vector<ekf::PixelPrediction>& predictions() const { return predictions_; }

  /// Looks for the predicted ones, at most `max_measured`. `known_motion`: the camera's pose is already known
  /// from the images themselves, so that only a few pixels around each prediction are left to search.
  /// `hidden`: not looked for inside.
  std::vector<Sighting> find(const GrayImage& image, const ekf::Filter& filter, LandmarkTracks& tracks,
                             bool known_motion, const ConvexPolygon& hidden, SearchCounts& counts);

 private:
  std::optional<vision::PatchPyramid> predicted_patch(const ekf::Filter& filter,
                                                      const LandmarkTrack& track) const;

  SearchOptions options_;
  vision::ActiveSearch search_;
  std::vector<ekf::PixelPrediction> predictions_;
};

/// Where the landmark is, or a point far along its ray when it is at infinity [m].
Eigen::Vector3d finite_point(const ekf::LandmarkEstimate& landmark);

}  // namespace cosight::slam
