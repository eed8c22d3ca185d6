#include "robot_agent/vision/band_search.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace cosight::vision {

PatchMatch BandSearch::find(const GrayImage& image_F, const BandTarget& target, const EpipolarBand& band) {
  constexpr double kPieceLength = 40.0;  // [px] over which one warp holds
  peaks_.clear();
  searched_ = false;
  best_patch_ = Patch{};
  best_normal_ = 0;
  for (std::size_t i = 0; i + 1 < band.size(); ++i) {
    const EpipolarBand::Sample& from = band.sample(i);
    const EpipolarBand::Sample& to = band.sample(i + 1);
    const Eigen::Vector2d step = to.pixel - from.pixel;
    const int pieces = std::max(1, static_cast<int>(std::ceil(step.norm() / kPieceLength)));
    const double half_width = std::max(band.half_width(i), band.half_width(i + 1));
    const Eigen::Vector2d along = step.norm() > 1e-6 ? step.normalized() : Eigen::Vector2d::UnitX().eval();
    for (int k = 0; k < pieces; ++k) {
      const double s = static_cast<double>(k) / pieces;
      const double e = static_cast<double>(k + 1) / pieces;
      Piece piece{from.pixel + s * step, from.pixel + e * step, half_width,
                  from.inverse_distance + 0.5 * (s + e) * (to.inverse_distance - from.inverse_distance)};
      // The ends of the band are uncertain along it as well.
      if (i == 0 && k == 0) piece.begin -= half_width * along;
      if (i + 2 == band.size() && k + 1 == pieces) piece.end += half_width * along;
      search_piece(image_F, target, piece);
    }
  }
  if (!searched_) return {};
  std::sort(peaks_.begin(), peaks_.end(), [](const Peak& a, const Peak& b) { return a.score > b.score; });
  return judge_peaks(peaks_, image_F, best_patch_, options_, scan_);
}

void BandSearch::search_piece(const GrayImage& image_F, const BandTarget& target, const Piece& piece) {
  const auto direction = target.slam.camera.unproject(target.pixel_S);
  if (!direction) return;
  constexpr double kFarthest = 1e4;  // [m] stands for infinity
  const double distance = 1.0 / std::max(piece.inverse_distance, 1.0 / kFarthest);
  const Eigen::Vector3d p = target.slam.T_WC * (distance * direction->normalized());
  if (target.normals.empty())
    search_patch(image_F, predicted_warp(target.reference, target.wearer, p), target, piece, 0);
  for (std::size_t k = 0; k < target.normals.size(); ++k) {
    search_patch(image_F, predicted_warp(target.reference, target.wearer, p, target.normals[k]), target,
                 piece, k);
  }
}

void BandSearch::search_patch(const GrayImage& image_F, const std::optional<Eigen::Matrix2d>& A,
                              const BandTarget& target, const Piece& piece, std::size_t normal) {
  if (!A) return;
  const auto patch = warp(target.patch, *A, side_);
  if (!patch || patch->is_flat()) return;

  const Eigen::Vector2d along = (piece.end - piece.begin).norm() > 1e-6
                                    ? (piece.end - piece.begin).normalized()
                                    : Eigen::Vector2d::UnitX().eval();
  // Half a pixel more, so that no whole pixel falls between two pieces.
  const Eigen::Vector2d more = 0.5 * along;
  const Eigen::Vector2d across = (piece.half_width + 0.5) * Eigen::Vector2d(-along.y(), along.x());
  outline_.assign({piece.begin - more - across, piece.end + more - across, piece.end + more + across,
                   piece.begin - more + across});
  polygon_region(outline_, patch->half(), image_F, region_);
  if (std::all_of(region_.rows.begin(), region_.rows.end(),
                  [](const ScanRegion::Span& span) { return span.begin >= span.end; })) {
    return;
  }
  searched_ = true;
  constexpr int kPeaksOfOnePiece = 3;
  scan_.find_peaks(image_F, *patch, region_, kPeaksOfOnePiece, piece_peaks_);
  if (piece_peaks_.empty()) return;
  const bool improves = std::all_of(peaks_.begin(), peaks_.end(), [&](const Peak& peak) {
    return piece_peaks_.front().score > peak.score;
  });
  if (improves) {
    best_patch_ = *patch;
    best_normal_ = normal;
  }
  peaks_.insert(peaks_.end(), piece_peaks_.begin(), piece_peaks_.end());
}

}  // namespace cosight::vision
