#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot_agent/vision/patch.hpp"
#include "robot_agent/vision/zncc_scan.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

struct SearchOptions {
  double n_sigmas = 3.0;     ///< of the innovation covariance: the ellipse's size
  int max_half_window = 64;  ///< [px] bound of the ellipse; a longer search costs more than a lost landmark
  double min_score = 0.8;    ///< ZNCC; lower for strong changes of view or light
  /// Second best over best peak; above it the match is ambiguous. 1 accepts all. Lower for repeated texture.
  double max_second_ratio = 0.97;
  /// Larger regions are searched at half resolution first [positions].
  int max_exhaustive_positions = 2500;
};

enum class SearchOutcome {
  kFound,
  kOutsideImage,  ///< no place in the ellipse at which the patch lies in the image
  kFlatPatch,     ///< the patch has no texture to correlate
  kWeak,          ///< the best score is under min_score
  kAmbiguous,     ///< two peaks look alike
};

struct PatchMatch {
  SearchOutcome outcome = SearchOutcome::kOutsideImage;
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();        ///< best place, refined below the pixel
  Eigen::Vector2i best = Eigen::Vector2i::Zero();         ///< best whole pixel
  Eigen::Vector2i second_best = Eigen::Vector2i::Zero();  ///< of the next peak, if second_score > 0
  double score = 0.0;                                     ///< ZNCC at `best`
  double second_score = 0.0;                              ///< ZNCC of the next peak; 0 when there is none

  explicit operator bool() const { return outcome == SearchOutcome::kFound; }
};

/// Finds a patch inside the ellipse of its predicted pixel (equations, section 7). Regions up to
/// `max_exhaustive_positions` are searched wholly: the same best position as trying every one. Larger ones go
/// through the best peaks at half resolution. Keeps buffers: one per thread.
class ActiveSearch {
 public:
  explicit ActiveSearch(const SearchOptions& options = {}) : options_(options) {}

  /// `S`: innovation covariance of the pixel [px^2]. A half patch with no pixels (side 0) forbids the coarse
  /// stage.
  PatchMatch find(const GrayImage& image, const PatchPyramid& patch, const Eigen::Vector2d& predicted,
                  const Eigen::Matrix2d& S);

  const SearchOptions& options() const { return options_; }

 private:
  void find_coarse_to_fine(const GrayImage& image, const PatchPyramid& patch);
  void shrink_window(const GrayImage& image, int left, int top, int right, int bottom);

  SearchOptions options_;
  ZnccScan scan_;
  ScanRegion region_;
  ScanRegion coarse_region_;
  ScanRegion fine_region_;
  GrayImage half_image_;
  std::vector<Peak> peaks_;
  std::vector<Peak> coarse_peaks_;
  std::vector<Peak> fine_peaks_;
};

/// Picks the best and the next distinct peak, refines, and judges by the options.
PatchMatch judge_peaks(const std::vector<Peak>& peaks, const GrayImage& image, const Patch& patch,
                       const SearchOptions& options, ZnccScan& scan);

}  // namespace cosight::vision
