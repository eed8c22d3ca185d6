#include "robot_agent/vision/active_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>

#include "robot_agent/vision/align_patch.hpp"

namespace cosight::vision {
namespace {

constexpr int kMaxPeaks = 4;
constexpr int kDistinct = 2;  // [px] nearer peaks are one

int positions_in(const ScanRegion& region) {
  int positions = 0;
  for (const ScanRegion::Span& span : region.rows)
    positions += std::max(span.end - span.begin, 0);
  return positions;
}

bool is_distinct(const Peak& a, const Peak& b) {
  return std::max(std::abs(a.x - b.x), std::abs(a.y - b.y)) > kDistinct;
}

/// The part of `region` within `reach` of (x, y).
void square_region(int x, int y, int reach, const ScanRegion& region, ScanRegion& square) {
  const int bottom = region.top + static_cast<int>(region.rows.size());
  square.rows.clear();
  square.top = std::max(y - reach, region.top);
  for (int v = square.top; v < std::min(y + reach + 1, bottom); ++v) {
    const ScanRegion::Span& span = region.rows[static_cast<std::size_t>(v - region.top)];
    square.rows.push_back({std::max(span.begin, x - reach), std::min(span.end, x + reach + 1)});
  }
}

}  // namespace

PatchMatch judge_peaks(const std::vector<Peak>& peaks, const GrayImage& image, const Patch& patch,
                       const SearchOptions& options, ZnccScan& scan) {
  PatchMatch match;
  match.outcome = SearchOutcome::kWeak;
  if (peaks.empty()) return match;
  const Peak& best = peaks.front();
  match.best = {best.x, best.y};
  match.pixel = match.best.cast<double>();
  match.score = best.score;
  const auto second =
      std::find_if(peaks.begin() + 1, peaks.end(), [&](const Peak& peak) { return is_distinct(peak, best); });
  if (second != peaks.end()) {
    match.second_best = {second->x, second->y};
    match.second_score = second->score;
  }
  if (match.score < options.min_score) return match;
  const bool ambiguous = match.second_score > options.max_second_ratio * match.score;
  match.outcome = ambiguous ? SearchOutcome::kAmbiguous : SearchOutcome::kFound;
  match.pixel = scan.refine(image, patch, best);
  match.pixel = align_patch(image, patch, match.pixel).value_or(match.pixel);
  return match;
}

PatchMatch ActiveSearch::find(const GrayImage& image, const PatchPyramid& patch,
                              const Eigen::Vector2d& predicted, const Eigen::Matrix2d& S) {
  PatchMatch match;
  if (patch.full.is_flat()) {
    match.outcome = SearchOutcome::kFlatPatch;
    return match;
  }
  ellipse_region(predicted, S, options_.n_sigmas, options_.max_half_window, patch.full.half(), image,
                 region_);
  const int positions = positions_in(region_);
  if (positions == 0) return match;
  if (positions <= options_.max_exhaustive_positions || patch.half.is_flat()) {
    scan_.find_peaks(image, patch.full, region_, kMaxPeaks, peaks_);
  } else {
    find_coarse_to_fine(image, patch);
  }
  return judge_peaks(peaks_, image, patch.full, options_, scan_);
}

// Pixel (i, j) of the half image is the mean of the four pixels at (left + 2 i, top + 2 j) and after; its
// centre lies half a pixel further. Margins for the patch repeat the border.
void ActiveSearch::shrink_window(const GrayImage& image, int left, int top, int right, int bottom) {
  half_image_.width = (right - left) / 2 + 1;
  half_image_.height = (bottom - top) / 2 + 1;
  half_image_.data.resize(static_cast<std::size_t>(half_image_.width) *
                          static_cast<std::size_t>(half_image_.height));
  for (int j = 0; j < half_image_.height; ++j) {
    const std::uint8_t* upper = image.row(std::clamp(top + 2 * j, 0, image.height - 1));
    const std::uint8_t* lower = image.row(std::clamp(top + 2 * j + 1, 0, image.height - 1));
    std::uint8_t* to = half_image_.row(j);
    for (int i = 0; i < half_image_.width; ++i) {
      const int x0 = std::clamp(left + 2 * i, 0, image.width - 1);
      const int x1 = std::clamp(left + 2 * i + 1, 0, image.width - 1);
      to[i] = static_cast<std::uint8_t>((upper[x0] + upper[x1] + lower[x0] + lower[x1] + 2) / 4);
    }
  }
}

void ActiveSearch::find_coarse_to_fine(const GrayImage& image, const PatchPyramid& patch) {
  int left = image.width;
  int right = 0;
  for (const ScanRegion::Span& span : region_.rows) {
    if (span.begin >= span.end) continue;
    left = std::min(left, span.begin);
    right = std::max(right, span.end - 1);
  }
  const int margin = 2 * patch.half.half() + 2;
  left -= margin;
  const int top = region_.top - margin;
  const int bottom = region_.top + static_cast<int>(region_.rows.size()) - 1 + margin;
  shrink_window(image, left, top, right + margin, bottom);

  const int patch_half = patch.half.half();
  coarse_region_.top = patch_half;
  coarse_region_.rows.clear();
  for (int j = patch_half; j < half_image_.height - patch_half; ++j) {
    const int y = std::clamp(top + 2 * j - region_.top, 0, static_cast<int>(region_.rows.size()) - 1);
    const ScanRegion::Span& span = region_.rows[static_cast<std::size_t>(y)];
    if (span.begin >= span.end) {
      coarse_region_.rows.push_back({});
      continue;
    }
    coarse_region_.rows.push_back({std::max((span.begin - left) / 2, patch_half),
                                   std::min((span.end - left) / 2 + 1, half_image_.width - patch_half)});
  }
  scan_.find_peaks(half_image_, patch.half, coarse_region_, 2 * kMaxPeaks, coarse_peaks_);
  peaks_.clear();
  constexpr int kReach = 2;  // [px] half a coarse pixel, and one for its noise
  for (const Peak& coarse : coarse_peaks_) {
    square_region(left + 2 * coarse.x, top + 2 * coarse.y, kReach, region_, fine_region_);
    scan_.find_peaks(image, patch.full, fine_region_, 1, fine_peaks_);
    peaks_.insert(peaks_.end(), fine_peaks_.begin(), fine_peaks_.end());
  }
  std::sort(peaks_.begin(), peaks_.end(), [](const Peak& a, const Peak& b) { return a.score > b.score; });
}

}  // namespace cosight::vision
