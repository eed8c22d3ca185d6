#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <cstdint>
#include <vector>

#include "robot_agent/vision/patch.hpp"
#include "robot_agent/vision/zncc_kernel.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// Where a patch's centre may lie: for each row from `top` on, columns begin <= x < end.
struct ScanRegion {
  struct Span {
    int begin = 0;
    int end = 0;
  };
  int top = 0;
  std::vector<Span> rows;
};

/// The pixels within `n_sigmas` of `centre` under covariance S [px^2], at most `max_half` from it along x and
/// y; only those at which a patch of half side `patch_half` lies in the image.
void ellipse_region(const Eigen::Vector2d& centre, const Eigen::Matrix2d& S, double n_sigmas, int max_half,
                    int patch_half, const GrayImage& image, ScanRegion& region);

/// The pixels inside a convex polygon of at least four corners or so, likewise.
void polygon_region(const ConvexPolygon& polygon, int patch_half, const GrayImage& image, ScanRegion& region);

/// A local maximum of the correlation.
struct Peak {
  int x = 0;
  int y = 0;
  double score = -1.0;  ///< ZNCC in [-1, 1]
};

/// ZNCC of one patch at every position of a region. Exact integer sums, double precision quotient. Keeps its
/// buffers from call to call.
class ZnccScan {
 public:
  /// `peaks` receives the local maxima (over eight neighbours inside the region), best first, at most
  /// `max_peaks`; none under a ZNCC of 0.1.
  void find_peaks(const GrayImage& image, const Patch& patch, const ScanRegion& region, int max_peaks,
                  std::vector<Peak>& peaks);

  /// The score at one position, which must be at least the patch's half side inside the image.
  double score_at(const GrayImage& image, const Patch& patch, int x, int y);

  /// The top of the quadratic surface through the scores around a peak [px]; the peak itself where a
  /// neighbour does not lie in the image.
  Eigen::Vector2d refine(const GrayImage& image, const Patch& patch, const Peak& peak);

 private:
  void load_window(const GrayImage& image, const Patch& patch, int left, int top, int width, int height);
  void sum_columns(int row, int side);
  void score_row(const Patch& patch, int row, const ScanRegion::Span& span, int left);

  bool is_peak(const float* score) const;
  float* score_at_row(int row) {
    return scores_.data() + static_cast<std::ptrdiff_t>(row + 1) * scores_stride_ + 1;
  }

  CorrelateRow correlate_row_ = fastest_correlate_row();
  int stride_ = 0;                      ///< of window_, in elements
  int window_width_ = 0;                ///< [px]
  std::vector<std::int16_t> window_;    ///< gray level - the patch's mean
  std::vector<std::int32_t> column_;    ///< sum over the patch's height of a column of window_
  std::vector<std::int32_t> column2_;   ///< the same of squares
  std::vector<std::int32_t> products_;  ///< sums of products of one row
  std::vector<std::int32_t> sums_;      ///< sums of windows of one row
  std::vector<std::int32_t> sums2_;     ///< the same of squares
  int scores_stride_ = 0;
  std::vector<float> scores_;  ///< sign(ZNCC) ZNCC^2, -2 outside the region, one more on every side
};

}  // namespace cosight::vision
