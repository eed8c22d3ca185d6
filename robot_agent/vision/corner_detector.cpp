#include "robot_agent/vision/corner_detector.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <opencv2/features2d.hpp>

#include "robot_agent/vision/index.hpp"
#include "robot_agent/vision/opencv_view.hpp"

namespace cosight::vision {
namespace {

struct RankedCorner {
  Corner corner;
  int cell = 0;
  int rank = 0;  ///< corners and occupied pixels of its cell that come before it
};

/// Counts per cell of a grid over the image.
class CellCounts {
 public:
  CellCounts(const GrayImage& image, int cell)
      : cell_(cell), columns_(image.width / cell + 1), rows_(image.height / cell + 1) {
    counts_.resize(index(columns_ * rows_), 0);
  }
  int cell_of(const Eigen::Vector2d& pixel) const {
    const int column = std::clamp(static_cast<int>(pixel.x()) / cell_, 0, columns_ - 1);
    const int row = std::clamp(static_cast<int>(pixel.y()) / cell_, 0, rows_ - 1);
    return row * columns_ + column;
  }
  int count_one_more(int cell) { return counts_[static_cast<std::size_t>(cell)]++; }

 private:
  int cell_;
  int columns_;
  int rows_;
  std::vector<int> counts_;
};

/// Pixels of the region in which FAST may look; empty when there are none.
cv::Rect searched_box(const GrayImage& image, const CornerOptions& options, const ConvexPolygon* roi) {
  const int border = std::max(options.border, 4);
  cv::Rect box(border, border, image.width - 2 * border, image.height - 2 * border);
  if (box.width <= 0 || box.height <= 0) return {};
  if (roi == nullptr) return box;
  if (roi->size() < 3) return {};
  const Rectangle bounds = bounding_box(*roi);
  const cv::Point low(static_cast<int>(std::floor(bounds.min.x())),
                      static_cast<int>(std::floor(bounds.min.y())));
  const cv::Point high(static_cast<int>(std::ceil(bounds.max.x())) + 1,
                       static_cast<int>(std::ceil(bounds.max.y())) + 1);
  return box & cv::Rect(low, high);
}

/// The best corner of every 4x4 pixels that FAST proposes.
std::vector<Corner> propose(const GrayImage& image, const CornerOptions& options, const ConvexPolygon* roi,
                            bool suppress_neighbours) {
  constexpr int kFastRadius = 3;
  constexpr int kBlock = 4;
  const cv::Rect box = searched_box(image, options, roi);
  if (box.empty()) return {};
  const cv::Rect searched(box.x - kFastRadius, box.y - kFastRadius, box.width + 2 * kFastRadius,
                          box.height + 2 * kFastRadius);
  std::vector<cv::KeyPoint> keypoints;
  cv::FAST(opencv_view(image)(searched), keypoints, options.fast_threshold, suppress_neighbours);
  const int columns = searched.width / kBlock + 1;
  std::vector<Corner> best(index(columns * (searched.height / kBlock + 1)));
  for (const cv::KeyPoint& keypoint : keypoints) {
    const int x = static_cast<int>(keypoint.pt.x);
    const int y = static_cast<int>(keypoint.pt.y);
    const Eigen::Vector2d pixel(searched.x + x, searched.y + y);
    const double score = shi_tomasi_score(image, searched.x + x, searched.y + y);
    Corner& corner = best[index(y / kBlock * columns + x / kBlock)];
    if (score > corner.score) corner = {pixel, score};
  }
  std::erase_if(best, [&](const Corner& corner) {
    return !(corner.score >= options.min_score) || (roi != nullptr && !contains(*roi, corner.pixel));
  });
  return best;
}

bool is_clear(const Eigen::Vector2d& pixel, const std::vector<Eigen::Vector2d>& taken, double min_distance) {
  return std::none_of(taken.begin(), taken.end(), [&](const Eigen::Vector2d& other) {
    return (pixel - other).squaredNorm() < min_distance * min_distance;
  });
}

}  // namespace

double shi_tomasi_score(const GrayImage& image, int x, int y) {
  constexpr int kHalf = 3;
  int xx = 0;
  int xy = 0;
  int yy = 0;
  for (int v = y - kHalf; v <= y + kHalf; ++v) {
    const std::uint8_t* above = image.row(v - 1);
    const std::uint8_t* row = image.row(v);
    const std::uint8_t* below = image.row(v + 1);
    for (int u = x - kHalf; u <= x + kHalf; ++u) {
      const int gx = row[u + 1] - row[u - 1];
      const int gy = below[u] - above[u];
      xx += gx * gx;
      xy += gx * gy;
      yy += gy * gy;
    }
  }
  const double scale = 1.0 / (4.0 * (2 * kHalf + 1) * (2 * kHalf + 1));
  const double mean = 0.5 * scale * (xx + yy);
  const double difference = 0.5 * scale * (xx - yy);
  return mean - std::hypot(difference, scale * xy);
}

std::vector<Corner> CornerDetector::detect(const GrayImage& image,
                                           const std::vector<Eigen::Vector2d>& occupied, int max_corners,
                                           const ConvexPolygon* roi) const {
  CellCounts cells(image, options_.cell);
  for (const Eigen::Vector2d& pixel : occupied)
    cells.count_one_more(cells.cell_of(pixel));
  std::vector<RankedCorner> ranked;
  std::vector<Corner> proposed = propose(image, options_, roi, true);
  // FAST drops all of several equal neighbours, which clean drawings have: ask again where little is found.
  if (static_cast<int>(proposed.size()) < max_corners) proposed = propose(image, options_, roi, false);
  for (const Corner& corner : proposed) {
    if (!is_clear(corner.pixel, occupied, options_.min_distance)) continue;
    ranked.push_back({corner, cells.cell_of(corner.pixel), 0});
  }
  std::stable_sort(ranked.begin(), ranked.end(), [](const RankedCorner& a, const RankedCorner& b) {
    return a.corner.score > b.corner.score;
  });
  for (RankedCorner& candidate : ranked)
    candidate.rank = cells.count_one_more(candidate.cell);
  std::stable_sort(ranked.begin(), ranked.end(),
                   [](const RankedCorner& a, const RankedCorner& b) { return a.rank < b.rank; });

  std::vector<Corner> corners;
  std::vector<Eigen::Vector2d> taken;
  for (const RankedCorner& candidate : ranked) {
    if (static_cast<int>(corners.size()) >= max_corners) break;
    if (!is_clear(candidate.corner.pixel, taken, options_.min_distance)) continue;
    corners.push_back(candidate.corner);
    taken.push_back(candidate.corner.pixel);
  }
  return corners;
}

}  // namespace cosight::vision
