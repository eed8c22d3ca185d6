#pragma once

#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/pseudo_stereo.hpp"

namespace cosight::slam {

/// What Cs and Cf together, and nothing of the frames before, say about the distance of landmarks: of those
/// matches that the filter believed. `matches`: one entry a sighting.
std::vector<StereoDepth> fused_depths(const ekf::StereoRig& rig, const std::vector<Sighting>& sightings,
                                      const PseudoStereo::Matches& matches, const ekf::UpdateReport& report);

}  // namespace cosight::slam
