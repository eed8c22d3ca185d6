#pragma once

#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/new_points.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::slam {

/// Puts the new points of one frame into the filter, with depth at once, and takes their patches from Cs.
/// `correlated`: they share the error of Cf's pose (docs/decisions/0005). Returns how many there was room and
/// parallax for; the others are counted.
int start_landmarks(const std::vector<NewPoint>& points, const ekf::StereoRig& rig, const GrayImage& image_S,
                    bool correlated, ekf::Filter& filter, LandmarkTracks& tracks, PseudoStereoCounts& counts);

}  // namespace cosight::slam
