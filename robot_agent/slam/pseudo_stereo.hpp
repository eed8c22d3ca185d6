#pragma once

#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/slam/stereo_view.hpp"
#include "robot_agent/vision/active_search.hpp"

namespace cosight::slam {

/// Depth of known landmarks from the wearer's view (C section 3.1).
class PseudoStereo {
 public:
  PseudoStereo(const PseudoStereoOptions& options, double pixel_sigma);

  /// One measurement a sighting: a point where the landmark was found in Cf inside its epipolar band as well
  /// (C5), a pixel otherwise (C6).
  std::vector<ekf::Measurement> measure(const std::optional<StereoView>& view, const GrayImage* image_S,
                                        const std::vector<Sighting>& sightings, const ekf::Filter& filter,
                                        PseudoStereoCounts& counts);

 private:
  std::optional<ekf::PointMeasurement> measure_point(const StereoView& view, const GrayImage& image_S,
                                                     const Sighting& sighting, const ekf::Filter& filter,
                                                     PseudoStereoCounts& counts);

  PseudoStereoOptions options_;
  double pixel_sigma_;
  vision::ActiveSearch search_;
};

/// How a patch of Cs is looked for in Cf.
vision::SearchOptions band_search_options(const PseudoStereoOptions& options);

/// The last stage at which any match was left.
PseudoStereoOutcome outcome_of(const PseudoStereoCounts& counts);

}  // namespace cosight::slam
