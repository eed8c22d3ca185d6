#pragma once

#include <cstdint>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/new_points.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/slam/pseudo_stereo.hpp"
#include "robot_agent/slam/stereo_view.hpp"

namespace cosight::slam {

/// What one worn frame shows of the map, and what it shows of places that the map does not have yet.
struct WornMatches {
  PseudoStereo::Matches landmarks;  ///< one entry a sighting
  std::vector<Guess> corners;       ///< that helped to find the pose of Cf, and agree with it
};

/// Finds the landmarks that Cs sees in Cf as well, and with them the pose of Cf: the sensors' pose is the
/// prior, the epipolar errors of the matches correct it (refine_rig). Where known landmarks are too few for
/// that, new corners help.
class WearerMatcher {
 public:
  WearerMatcher(const PseudoStereoOptions& options, double pixel_sigma, int min_distance_px,
                std::uint32_t seed);

  /// Leaves the better pose in `view.rig`. `is_start`: no landmark is known yet, and time matters less.
  WornMatches match(StereoView& view, const GrayImage& image_S, const std::vector<Sighting>& sightings,
                    const ekf::Filter& filter, LandmarkTracks& tracks, bool is_start,
                    PseudoStereoCounts& counts);

  /// One measurement a sighting, see PseudoStereo.
  std::vector<ekf::Measurement> measure(const std::optional<StereoView>& view,
                                        const std::vector<Sighting>& sightings, const WornMatches& matches,
                                        PseudoStereoCounts& counts) const {
    return pseudo_stereo_.measure(view, sightings, matches.landmarks, counts);
  }

  /// New points for the map: from the corners that were matched already, or by a search of its own.
  std::vector<NewPoint> new_points(const StereoView& view, const GrayImage& image_S,
                                   const WornMatches& matches, const std::vector<Eigen::Vector2d>& occupied,
                                   const NewPoints::Budget& budget, PseudoStereoCounts& counts);

 private:
  std::vector<Guess> corners_for(const StereoView& view, const GrayImage& image_S,
                                 const std::vector<Eigen::Vector2d>& occupied, int known, bool is_start);

  PseudoStereoOptions options_;
  std::uint32_t seed_;
  PseudoStereo pseudo_stereo_;
  NewPoints new_points_;
};

}  // namespace cosight::slam
