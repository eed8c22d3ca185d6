#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/landmark_search.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/vision/band_search.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/descriptor.hpp"
#include "robot_agent/vision/epipolar_band.hpp"

namespace cosight::slam {

/// One frame of the wearer's camera, ready to be measured against: the views overlap.
struct StereoView {
  const GrayImage* image_F = nullptr;
  ekf::StereoRig rig;
  OverlapEstimate overlap;
  ConvexPolygon silhouette;  ///< the wearer's own body in Cs [px]: nothing inside is used
};

/// T_SF of a worn view; its orientation from the AHRS where only a position is given:
/// R_SF = R_WS^T R_WF, with the errors of both in the axes of S. Nothing without any orientation.
std::optional<UncertainPose> wearer_pose(const WearerView& wearer, const UncertainPose& T_WS);

/// Depth from the wearer's view (C sections 2 and 3): landmarks that Cf sees as well become points, and new
/// points start at once.
class PseudoStereo {
 public:
  PseudoStereo(const PseudoStereoOptions& options, double pixel_sigma, int min_distance_px);

  /// One measurement a sighting: a point where the landmark was found in Cf along its epipolar band as well
  /// (C5), a pixel otherwise (C6).
  std::vector<ekf::Measurement> measure(const std::optional<StereoView>& view, const GrayImage* image_S,
                                        const std::vector<Sighting>& sightings, const ekf::Filter& filter,
                                        PseudoStereoCounts& counts);

  /// At most `wanted` new points inside both ROIs, away from the `occupied` pixels and from each other.
  std::vector<ekf::StereoMatch> find_new(const StereoView& view, const GrayImage& image_S,
                                         const std::vector<Eigen::Vector2d>& occupied, int wanted,
                                         PseudoStereoCounts& counts);

 private:
  std::optional<ekf::PointMeasurement> measure_point(const StereoView& view, const GrayImage& image_S,
                                                     const Sighting& sighting, const ekf::Filter& filter,
                                                     PseudoStereoCounts& counts);
  std::optional<ekf::StereoMatch> match_corner(const StereoView& view, const GrayImage& image_S,
                                               const Eigen::Vector2d& pixel_S, PseudoStereoCounts& counts);
  bool has_depth(const ekf::StereoPoint& point, const ekf::StereoRig& rig) const;

  PseudoStereoOptions options_;
  double pixel_sigma_;
  vision::ActiveSearch search_;
  vision::BandSearch band_search_;
  vision::CornerDetector corners_;
  std::unique_ptr<vision::DescriptorExtractor> extractor_;
};

/// The last stage at which any match was left.
PseudoStereoOutcome outcome_of(const PseudoStereoCounts& counts);

}  // namespace cosight::slam
