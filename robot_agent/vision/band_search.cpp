#include "robot_agent/vision/band_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cosight::vision {
namespace {

constexpr int kPeaksOfOnePiece = 3;

Eigen::Vector2d direction_of(const Eigen::Vector2d& step) {
  return step.norm() > 1e-6 ? Eigen::Vector2d(step.normalized()) : Eigen::Vector2d::UnitX();
}

/// The square of pixels within `reach` of (x, y) at which a patch lies in the image.
void square_region(int x, int y, int reach, int patch_half, const GrayImage& image, ScanRegion& region) {
  region.top = std::max(y - reach, patch_half);
  region.rows.clear();
  for (int row = region.top; row <= std::min(y + reach, image.height - 1 - patch_half); ++row) {
    region.rows.push_back(
        {std::max(x - reach, patch_half), std::min(x + reach + 1, image.width - patch_half)});
  }
}

bool is_empty(const ScanRegion& region) {
  return std::all_of(region.rows.begin(), region.rows.end(),
                     [](const ScanRegion::Span& span) { return span.begin >= span.end; });
}

}  // namespace

PatchMatch BandSearch::find(const ImagePyramid& image_F, const BandTarget& target, const EpipolarBand& band) {
  peaks_.clear();
  searched_ = false;
  best_patch_ = Patch{};
  best_normal_ = 0;
  cut_band(band);
  make_hypotheses(target);
  if (positions() <= options_.max_exhaustive_positions) {
    search_exhaustively(*image_F.full, target.patch);
  } else {
    search_coarse_to_fine(image_F, target.patch);
  }
  if (!searched_) return {};
  std::sort(peaks_.begin(), peaks_.end(), [](const Peak& a, const Peak& b) { return a.score > b.score; });
  return judge_peaks(peaks_, *image_F.full, best_patch_, options_, scan_);
}

void BandSearch::cut_band(const EpipolarBand& band) {
  constexpr double kPieceLength = 40.0;  // [px] over which one warp holds
  pieces_.clear();
  for (std::size_t i = 0; i + 1 < band.size(); ++i) {
    const EpipolarBand::Sample& from = band.sample(i);
    const EpipolarBand::Sample& to = band.sample(i + 1);
    const Eigen::Vector2d step = to.pixel - from.pixel;
    const int count = std::max(1, static_cast<int>(std::ceil(step.norm() / kPieceLength)));
    const double half_width = std::max(band.half_width(i), band.half_width(i + 1));
    for (int k = 0; k < count; ++k) {
      const double s = static_cast<double>(k) / count;
      const double e = static_cast<double>(k + 1) / count;
      pieces_.push_back(
          {from.pixel + s * step, from.pixel + e * step, half_width,
           from.inverse_distance + 0.5 * (s + e) * (to.inverse_distance - from.inverse_distance)});
    }
  }
  // The ends of the band are uncertain along it as well.
  Piece& first = pieces_.front();
  Piece& last = pieces_.back();
  first.begin -= first.half_width * direction_of(first.end - first.begin);
  last.end += last.half_width * direction_of(last.end - last.begin);
}

void BandSearch::make_hypotheses(const BandTarget& target) {
  hypotheses_.clear();
  const auto direction = target.slam.camera.unproject(target.pixel_S);
  if (!direction) return;
  constexpr double kFarthest = 1e4;  // [m] stands for infinity
  for (std::size_t i = 0; i < pieces_.size(); ++i) {
    const double distance = 1.0 / std::max(pieces_[i].inverse_distance, 1.0 / kFarthest);
    const Eigen::Vector3d p = target.slam.T_WC * (distance * direction->normalized());
    if (target.normals.empty()) add_hypothesis(predicted_warp(target.reference, target.wearer, p), i, 0);
    for (std::size_t k = 0; k < target.normals.size(); ++k)
      add_hypothesis(predicted_warp(target.reference, target.wearer, p, target.normals[k]), i, k);
  }
}

void BandSearch::add_hypothesis(const std::optional<Eigen::Matrix2d>& A, std::size_t piece,
                                std::size_t normal) {
  if (A) hypotheses_.push_back({piece, normal, *A});
}

double BandSearch::positions() const {
  double sum = 0.0;
  for (const Hypothesis& hypothesis : hypotheses_) {
    const Piece& piece = pieces_[hypothesis.piece];
    sum += (piece.end - piece.begin).norm() * (2.0 * piece.half_width + 1.0);
  }
  return sum;
}

bool BandSearch::region_of(const Piece& piece, double scale, int patch_half, const GrayImage& image) {
  const Eigen::Vector2d along = direction_of(piece.end - piece.begin);
  // Half a pixel more, so that no whole pixel falls between two pieces.
  const Eigen::Vector2d more = 0.5 * along;
  const Eigen::Vector2d across = (scale * piece.half_width + 0.5) * Eigen::Vector2d(-along.y(), along.x());
  const auto scaled = [scale](const Eigen::Vector2d& pixel) -> Eigen::Vector2d {
    return scale * (pixel.array() + 0.5).matrix() - Eigen::Vector2d(0.5, 0.5);
  };
  const Eigen::Vector2d begin = scaled(piece.begin) - more;
  const Eigen::Vector2d end = scaled(piece.end) + more;
  outline_.assign({begin - across, end - across, end + across, begin + across});
  polygon_region(outline_, patch_half, image, region_);
  return !is_empty(region_);
}

void BandSearch::take(const Patch& patch, std::size_t normal) {
  if (piece_peaks_.empty()) return;
  const bool improves = std::all_of(peaks_.begin(), peaks_.end(), [&](const Peak& peak) {
    return piece_peaks_.front().score > peak.score;
  });
  if (improves) {
    best_patch_ = patch;
    best_normal_ = normal;
  }
  peaks_.insert(peaks_.end(), piece_peaks_.begin(), piece_peaks_.end());
}

void BandSearch::search_exhaustively(const GrayImage& image_F, const ReferencePatch& reference) {
  for (const Hypothesis& hypothesis : hypotheses_) {
    const auto patch = warp(reference, hypothesis.A, side_);
    if (!patch || patch->is_flat()) continue;
    if (!region_of(pieces_[hypothesis.piece], 1.0, patch->half(), image_F)) continue;
    searched_ = true;
    scan_.find_peaks(image_F, *patch, region_, kPeaksOfOnePiece, piece_peaks_);
    take(*patch, hypothesis.normal);
  }
}

void BandSearch::find_coarse_peaks(const GrayImage& half_image_F, const ReferencePatch& reference) {
  constexpr int kCoarseSide = 9;  // shows half as much again as the patch at full resolution
  coarse_peaks_.clear();
  for (std::size_t i = 0; i < hypotheses_.size(); ++i) {
    const auto patch = warp(reference, 0.5 * hypotheses_[i].A, kCoarseSide);
    if (!patch || patch->is_flat()) continue;
    if (!region_of(pieces_[hypotheses_[i].piece], 0.5, patch->half(), half_image_F)) continue;
    searched_ = true;
    scan_.find_peaks(half_image_F, *patch, region_, kPeaksOfOnePiece, piece_peaks_);
    for (const Peak& peak : piece_peaks_)
      coarse_peaks_.push_back({peak, i});
  }
}

void BandSearch::search_coarse_to_fine(const ImagePyramid& image_F, const ReferencePatch& reference) {
  find_coarse_peaks(image_F.half, reference);
  constexpr std::size_t kRefined = 10;
  constexpr int kReach = 2;  // [px] half a coarse pixel, and one for its noise
  const std::size_t count = std::min(kRefined, coarse_peaks_.size());
  std::partial_sort(coarse_peaks_.begin(), coarse_peaks_.begin() + static_cast<std::ptrdiff_t>(count),
                    coarse_peaks_.end(),
                    [](const CoarsePeak& a, const CoarsePeak& b) { return a.peak.score > b.peak.score; });
  for (std::size_t k = 0; k < count; ++k) {
    const Hypothesis& hypothesis = hypotheses_[coarse_peaks_[k].hypothesis];
    const auto patch = warp(reference, hypothesis.A, side_);
    if (!patch || patch->is_flat()) continue;
    const Peak& coarse = coarse_peaks_[k].peak;
    square_region(2 * coarse.x, 2 * coarse.y, kReach, patch->half(), *image_F.full, region_);
    if (is_empty(region_)) continue;
    scan_.find_peaks(*image_F.full, *patch, region_, 1, piece_peaks_);
    take(*patch, hypothesis.normal);
  }
}

}  // namespace cosight::vision
