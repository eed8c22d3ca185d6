#pragma once

#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "shared/dataset/known_point.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::slam {

/// Metric start from surveyed points (equations section 8): the pose is that of their pixels in the first
/// image (PnP), and they enter the map with small covariance. A point without a pixel is expected where the
/// configured start pose shows it. False when fewer than four are in view or no pose fits them; nothing has
/// changed then.
bool start_from_known_points(const std::vector<KnownPoint>& points, const GrayImage& image,
                             const SlamOptions& options, ekf::Filter& filter, LandmarkTracks& tracks);

/// Starts the map with corners of one image, all at the same depth [m]: nothing tells the scale. False, and
/// nothing changed, with fewer than `start.min_landmarks`.
bool start_at_assumed_depth(double depth, const GrayImage& image, const vision::CornerDetector& detector,
                            const SlamOptions& options, ekf::Filter& filter, LandmarkTracks& tracks);

}  // namespace cosight::slam
