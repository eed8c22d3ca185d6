#pragma once

#include <Eigen/Core>
#include <memory>
#include <optional>
#include <vector>

#include "robot_agent/ekf/triangulation.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/slam/stereo_view.hpp"
#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/band_search.hpp"
#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/descriptor.hpp"
#include "robot_agent/vision/epipolar_band.hpp"

namespace cosight::slam {

/// A new point in both cameras, and which way its surface faces (axes of S) where the match has shown it.
struct NewPoint {
  ekf::StereoMatch match;
  std::optional<Eigen::Vector3d> normal_S;
};

/// A corner and where it may be in Cf.
struct Guess {
  NewPoint point;
  bool is_ambiguous = false;
};

/// New points that both cameras see, inside the overlap (C section 2): corners of Cs by ZNCC along their
/// epipolar band, or features of both by descriptors that compete within the band.
class NewPoints {
 public:
  NewPoints(const PseudoStereoOptions& options, int min_distance_px);

  /// How many, and how many corners may be tried for them: a band costs about as much as a dozen landmarks.
  struct Budget {
    int points = 0;
    int tries = 0;
  };

  /// Away from the `occupied` pixels of Cs, from each other, and from corners that lately had no match.
  std::vector<NewPoint> find(const StereoView& view, const GrayImage& image_S,
                             const std::vector<Eigen::Vector2d>& occupied, const Budget& budget,
                             PseudoStereoCounts& counts);

  /// Corners of Cs inside the overlap with the best place in their band, however wide and however ambiguous:
  /// for a pose of Cf that is to be found. Away from the `occupied` pixels and from corners that lately had
  /// no match.
  std::vector<Guess> guesses(const StereoView& view, const GrayImage& image_S,
                             const std::vector<Eigen::Vector2d>& occupied, int tries);

  /// Forgets which corners had no match: another start tries them all.
  void forget_refusals() { refusals_.clear(); }

  /// Those of the guesses that are new points once the pose of Cf is known better.
  std::vector<NewPoint> judge(const StereoView& view, const std::vector<Guess>& guesses, int wanted,
                              PseudoStereoCounts& counts) const;

 private:
  std::vector<NewPoint> find_by_band(const StereoView& view, const GrayImage& image_S,
                                     const std::vector<Eigen::Vector2d>& occupied, const Budget& budget,
                                     PseudoStereoCounts& counts);
  std::vector<NewPoint> find_by_descriptors(const StereoView& view, const GrayImage& image_S,
                                            std::vector<Eigen::Vector2d> occupied, int wanted,
                                            PseudoStereoCounts& counts);
  void rest_refusals();
  std::vector<vision::Corner> corners_to_try(const StereoView& view, const GrayImage& image_S,
                                             std::vector<Eigen::Vector2d> occupied, int tries);
  std::optional<vision::EpipolarBand> band_of(const StereoView& view, const Eigen::Vector2d& pixel_S) const;
  vision::PatchMatch search_band(const StereoView& view, const GrayImage& image_S,
                                 const Eigen::Vector2d& pixel_S, const vision::EpipolarBand& band);
  std::optional<NewPoint> match_corner(const StereoView& view, const GrayImage& image_S,
                                       const Eigen::Vector2d& pixel_S, PseudoStereoCounts& counts);
  std::optional<ekf::StereoMatch> refine(const StereoView& view, const GrayImage& image_S,
                                         const ekf::StereoMatch& rough, PseudoStereoCounts& counts);
  bool accept(const StereoView& view, const ekf::StereoMatch& match, PseudoStereoCounts& counts) const;

  /// A corner that found no match stays out for a while, so that others get their turn.
  struct Refusal {
    Eigen::Vector2d pixel;
    int frames_left = 0;
  };

  PseudoStereoOptions options_;
  int min_distance_px_;
  vision::CornerDetector corners_;
  vision::BandSearch band_search_;
  vision::ImagePyramid pyramid_F_;
  std::array<Eigen::Vector3d, vision::kSurfaces> normals_S_;  ///< tried in the last search of a band
  vision::ActiveSearch refinement_;
  std::vector<Refusal> refusals_;
  std::unique_ptr<vision::DescriptorExtractor> extractor_;  ///< null: by band
};

}  // namespace cosight::slam
