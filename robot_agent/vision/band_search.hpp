#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <optional>
#include <span>
#include <vector>

#include "robot_agent/vision/active_search.hpp"
#include "robot_agent/vision/epipolar_band.hpp"
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

/// Guided ZNCC: the patch is warped as each distance hypothesis predicts and searched along the band. Keeps
/// buffers: one per thread.
class BandSearch {
 public:
  explicit BandSearch(const SearchOptions& options = {}, int side = 13) : options_(options), side_(side) {}

  /// Of the options, those of the ellipse do not apply. kOutsideImage when no hypothesis could be searched.
  PatchMatch find(const GrayImage& image_F, const BandTarget& target, const EpipolarBand& band);

  /// Which of the target's normals the last match was found with.
  std::size_t best_normal() const { return best_normal_; }

 private:
  struct Piece {
    Eigen::Vector2d begin, end;  ///< [px]
    double half_width;           ///< [px]
    double inverse_distance;     ///< in the middle [1/m]
  };
  void search_piece(const GrayImage& image_F, const BandTarget& target, const Piece& piece);
  void search_patch(const GrayImage& image_F, const std::optional<Eigen::Matrix2d>& A,
                    const BandTarget& target, const Piece& piece, std::size_t normal);

  Patch best_patch_;
  SearchOptions options_;
  int side_;
  ZnccScan scan_;
  ScanRegion region_;
  ConvexPolygon outline_;
  std::vector<Peak> piece_peaks_;
  std::vector<Peak> peaks_;
  bool searched_ = false;
  std::size_t best_normal_ = 0;
};

}  // namespace cosight::vision
