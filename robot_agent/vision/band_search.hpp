#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/epipolar_band.hpp"
#include "robot_agent/vision/image_pyramid.hpp"
#include "robot_agent/vision/patch.hpp"
#include "robot_agent/vision/patch_warp.hpp"
#include "robot_agent/vision/zncc_scan.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// A feature to be found in the worn camera: what it looked like, and from where each camera looks. All views
/// in one common frame.
struct BandTarget {
  const ReferencePatch& patch;
  View reference;                                     ///< where the patch was cut
  View slam;                                          ///< Cs now
  View wearer;                                        ///< Cf now
  Eigen::Vector2d pixel_S = Eigen::Vector2d::Zero();  ///< the feature in Cs now
  /// Ways in which its surface may face (axes of the common frame); none: towards the reference.
  std::span<const Eigen::Vector3d> normals = {};
};

/// Guided ZNCC: the patch is warped as each distance and each normal predict and searched along the band. A
/// wide band goes through the best places at half resolution first. Keeps buffers: one per thread.
class BandSearch {
 public:
  explicit BandSearch(const SearchOptions& options = {}, int side = 13) : options_(options), side_(side) {}

  /// Of the options, those of the ellipse do not apply. kOutsideImage when no hypothesis could be searched.
  PatchMatch find(const ImagePyramid& image_F, const BandTarget& target, const EpipolarBand& band);

  /// Which of the target's normals the last match was found with.
  std::size_t best_normal() const { return best_normal_; }

 private:
  struct Piece {
    Eigen::Vector2d begin, end;  ///< [px]
    double half_width;           ///< [px]
    double inverse_distance;     ///< in the middle [1/m]
  };
  /// What the patch would look like on one piece of the band.
  struct Hypothesis {
    std::size_t piece = 0;
    std::size_t normal = 0;
    Eigen::Matrix2d A;  ///< the warp
  };
  struct CoarsePeak {
    Peak peak;
    std::size_t hypothesis = 0;
  };

  void cut_band(const EpipolarBand& band);
  void make_hypotheses(const BandTarget& target);
  void add_hypothesis(const std::optional<Eigen::Matrix2d>& A, std::size_t piece, std::size_t normal);
  double positions() const;
  /// Where a patch of half side `patch_half` may lie on the piece, in an image `scale` times as large.
  bool region_of(const Piece& piece, double scale, int patch_half, const GrayImage& image);
  void search_exhaustively(const GrayImage& image_F, const ReferencePatch& reference);
  void search_coarse_to_fine(const ImagePyramid& image_F, const ReferencePatch& reference);
  void find_coarse_peaks(const GrayImage& half_image_F, const ReferencePatch& reference);
  void take(const Patch& patch, std::size_t normal);

  SearchOptions options_;
  int side_;
  ZnccScan scan_;
  ScanRegion region_;
  ConvexPolygon outline_;
  std::vector<Piece> pieces_;
  std::vector<Hypothesis> hypotheses_;
  std::vector<CoarsePeak> coarse_peaks_;
  std::vector<Peak> piece_peaks_;
  std::vector<Peak> peaks_;
  Patch best_patch_;
  std::size_t best_normal_ = 0;
  bool searched_ = false;
};

}  // namespace cosight::vision
