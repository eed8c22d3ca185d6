#pragma once

#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/slam/stereo_view.hpp"
#include "robot_agent/vision/active_search.hpp"

namespace cosight::slam {

/// Depth of known landmarks from the wearer's view (C section 3.1).
class PseudoStereo {
 public:
  /// Where the sighted landmarks are seen in Cf; one entry a sighting, nothing where a landmark was not
  /// found.
  using Matches = std::vector<std::optional<ekf::StereoMatch>>;

  PseudoStereo(const PseudoStereoOptions& options, double pixel_sigma);

  /// Each landmark inside the overlap is looked for in Cf where its point and the pose of Cf put it.
  Matches match(const StereoView& view, const GrayImage& image_S, const std::vector<Sighting>& sightings,
                const ekf::Filter& filter, LandmarkTracks& tracks, PseudoStereoCounts& counts);

  /// Each sighting as a pixel of Cs (C6); where it has a match, one of Cf as well, or both together as a
  /// point if there is depth in them (C5).
  std::vector<ekf::Measurement> measure(const std::optional<StereoView>& view,
                                        const std::vector<Sighting>& sightings, const Matches& matches,
                                        PseudoStereoCounts& counts) const;

 private:
  std::optional<ekf::StereoMatch> match_landmark(const StereoView& view, const GrayImage& image_S,
                                                 const Sighting& sighting, const ekf::Filter& filter,
                                                 LandmarkTrack& track, PseudoStereoCounts& counts);
  vision::PatchMatch search(const StereoView& view, const vision::ReferencePatch& reference,
                            const Eigen::Vector3d& p_S, const Eigen::Vector3d& normal_S,
                            const Eigen::Vector2d& predicted, const Eigen::Matrix2d& S);
  std::optional<ekf::PointMeasurement> point_of(const StereoView& view, const ekf::StereoMatch& match,
                                                PseudoStereoCounts& counts) const;

  PseudoStereoOptions options_;
  double pixel_sigma_;
  vision::ActiveSearch search_;
};

/// How a patch of Cs is looked for in Cf.
vision::SearchOptions band_search_options(const PseudoStereoOptions& options);

/// The last stage at which any match was left.
PseudoStereoOutcome outcome_of(const PseudoStereoCounts& counts);

}  // namespace cosight::slam
