#include "robot_agent/vision/zncc_scan.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <cstddef>

#include "robot_agent/vision/index.hpp"

namespace cosight::vision {
namespace {

constexpr float kOutside = -2.0F;
constexpr float kLeastPeak = 0.01F;  // ZNCC 0.1, squared: less is no likeness at all
constexpr double kMaxOffset = 0.75;  // [px] farther from its pixel a peak would be another pixel's

ScanRegion::Span clipped_span(double begin, double last, int patch_half, int width) {
  // Bounds first: a span of a far-off ellipse would not fit an int.
  const double low = std::max(std::ceil(begin), static_cast<double>(patch_half));
  const double high = std::min(std::floor(last), static_cast<double>(width - 1 - patch_half));
  if (!(low <= high)) return {};
  return {static_cast<int>(low), static_cast<int>(high) + 1};
}

/// Sets the rows of `region` that lie in the image; returns whether there are any.
bool set_rows(double first, double last, int patch_half, int height, ScanRegion& region) {
  region.rows.clear();
  const double low = std::max(std::ceil(first), static_cast<double>(patch_half));
  const double high = std::min(std::floor(last), static_cast<double>(height - 1 - patch_half));
  if (!(low <= high)) return false;
  region.top = static_cast<int>(low);
  region.rows.resize(static_cast<std::size_t>(high - low) + 1);
  return true;
}

}  // namespace

// Row dy of the ellipse d^T S^-1 d <= n^2: with S^-1 = [a b; b c], dx = (-b dy +- sqrt(b^2 dy^2 - a (c dy^2 -
// n^2))) / a.
void ellipse_region(const Eigen::Vector2d& centre, const Eigen::Matrix2d& S, double n_sigmas, int max_half,
                    int patch_half, const GrayImage& image, ScanRegion& region) {
  region.rows.clear();
  const Eigen::Matrix2d information = S.inverse();
  if (!information.allFinite() || !centre.allFinite() || !(S.determinant() > 0.0)) return;
  const double a = information(0, 0);
  const double b = 0.5 * (information(0, 1) + information(1, 0));
  const double c = information(1, 1);
  const double reach = std::min(n_sigmas * std::sqrt(S(1, 1)), static_cast<double>(max_half));
  if (!set_rows(centre.y() - reach, centre.y() + reach, patch_half, image.height, region)) return;
  for (std::size_t i = 0; i < region.rows.size(); ++i) {
    const double dy = region.top + static_cast<double>(i) - centre.y();
    const double discriminant = b * b * dy * dy - a * (c * dy * dy - n_sigmas * n_sigmas);
    if (discriminant < 0.0) continue;
    const double middle = -b * dy / a;
    const double width = std::sqrt(discriminant) / a;
    const double begin = std::max(middle - width, -static_cast<double>(max_half));
    const double last = std::min(middle + width, static_cast<double>(max_half));
    region.rows[i] = clipped_span(centre.x() + begin, centre.x() + last, patch_half, image.width);
  }
}

void polygon_region(const ConvexPolygon& polygon, int patch_half, const GrayImage& image,
                    ScanRegion& region) {
  region.rows.clear();
  if (polygon.size() < 3) return;
  const Rectangle box = bounding_box(polygon);
  if (!set_rows(box.min.y(), box.max.y(), patch_half, image.height, region)) return;
  for (std::size_t i = 0; i < region.rows.size(); ++i) {
    const double y = region.top + static_cast<double>(i);
    double begin = box.max.x() + 1.0;
    double last = box.min.x() - 1.0;
    for (std::size_t k = 0; k < polygon.size(); ++k) {
      const Eigen::Vector2d& p = polygon[k];
      const Eigen::Vector2d& q = polygon[(k + 1) % polygon.size()];
      if ((p.y() < y && q.y() < y) || (p.y() > y && q.y() > y)) continue;
      if (p.y() == q.y()) {
        begin = std::min({begin, p.x(), q.x()});
        last = std::max({last, p.x(), q.x()});
        continue;
      }
      const double x = p.x() + (y - p.y()) / (q.y() - p.y()) * (q.x() - p.x());
      begin = std::min(begin, x);
      last = std::max(last, x);
    }
    region.rows[i] = clipped_span(begin, last, patch_half, image.width);
  }
}

void ZnccScan::load_window(const GrayImage& image, const Patch& patch, int left, int top, int width,
                           int height) {
  window_width_ = width;
  stride_ = width + Patch::kStride;  // the kernel reads a full padded row at the last position
  window_.resize(index(stride_ * height + kCorrelationBlock));
  column_.resize(index(width + 1));
  column2_.resize(index(width + 1));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* from = image.row(top + y) + left;
    std::int16_t* to = window_.data() + index(y * stride_);
    for (int x = 0; x < width; ++x)
      to[x] = static_cast<std::int16_t>(from[x] - patch.mean);
    std::fill(to + width, to + stride_, std::int16_t{0});
  }
}

/// Column sums for the row of positions `row`: fresh for the first, then one row in and one row out. The
/// squares are of 16-bit numbers, which is what the vector unit multiplies.
void ZnccScan::sum_columns(int row, int side) {
  const int width = window_width_;
  std::int32_t* column = column_.data();
  std::int32_t* column2 = column2_.data();
  const auto row_at = [this](int y) { return window_.data() + index(y * stride_); };
  if (row > 0) {
    const std::int16_t* leaving = row_at(row - 1);
    const std::int16_t* entering = row_at(row + side - 1);
    for (int x = 0; x < width; ++x) {
      column[x] += entering[x] - leaving[x];
      column2[x] += entering[x] * entering[x] - leaving[x] * leaving[x];
    }
    return;
  }
  std::fill_n(column, width, 0);
  std::fill_n(column2, width, 0);
  for (int y = 0; y < side; ++y) {
    const std::int16_t* entering = row_at(y);
    for (int x = 0; x < width; ++x) {
      column[x] += entering[x];
      column2[x] += entering[x] * entering[x];
    }
  }
}

// ZNCC = (n sum(t w) - sum(t) sum(w)) / sqrt((n sum(t^2) - sum(t)^2) (n sum(w^2) - sum(w)^2)). Its signed
// square has the same order and needs no root.
void ZnccScan::score_row(const Patch& patch, int row, const ScanRegion::Span& span, int left) {
  const int begin = span.begin - left;
  const int count = span.end - span.begin;
  correlate_row_(patch.deviations.data(), patch.side, window_.data() + index(row * stride_ + begin), stride_,
                 count, products_.data());
  const int side = patch.side;
  std::int32_t sum = 0;
  std::int32_t sum2 = 0;
  for (int c = 0; c < side; ++c) {
    sum += column_[index(begin + c)];
    sum2 += column2_[index(begin + c)];
  }
  for (int x = 0; x < count; ++x) {
    sums_[index(x)] = sum;
    sums2_[index(x)] = sum2;
    // After the last position a column past the window would come: column_ has room for it.
    sum += column_[index(begin + x + side)] - column_[index(begin + x)];
    sum2 += column2_[index(begin + x + side)] - column2_[index(begin + x)];
  }
  const double n = side * side;
  const double min_variation = n * n;  // one gray level of standard deviation
  const double scale = patch.inverse_norm * patch.inverse_norm;
  const double patch_sum = patch.sum;
  float* scores = score_at_row(row) + begin;
  for (int x = 0; x < count; ++x) {
    const double s = sums_[index(x)];
    const double variation = n * sums2_[index(x)] - s * s;
    const double covariation = n * products_[index(x)] - patch_sum * s;
    const double score = covariation * std::abs(covariation) * scale / std::max(variation, min_variation);
    scores[x] = variation < min_variation ? 0.0F : static_cast<float>(score);
  }
}

/// Greatest of its eight neighbours; of equal ones the first counts. The border of kOutside stops it.
bool ZnccScan::is_peak(const float* score) const {
  const float s = *score;
  const float* above = score - scores_stride_;
  const float* below = score + scores_stride_;
  return s > score[-1] && s >= score[1] && s > above[0] && s >= below[0] && s > above[-1] && s > above[1] &&
         s >= below[-1] && s >= below[1];
}

void ZnccScan::find_peaks(const GrayImage& image, const Patch& patch, const ScanRegion& region, int max_peaks,
                          std::vector<Peak>& peaks) {
  peaks.clear();
  int left = image.width;
  int right = -1;
  for (const ScanRegion::Span& span : region.rows) {
    if (span.begin >= span.end) continue;
    left = std::min(left, span.begin);
    right = std::max(right, span.end - 1);
  }
  if (right < left || patch.is_flat()) return;
  const int half = patch.half();
  const int width = right - left + 1;
  const int height = static_cast<int>(region.rows.size());
  load_window(image, patch, left - half, region.top - half, width + patch.side - 1, height + patch.side - 1);
  scores_stride_ = width + 2;
  scores_.assign(index(scores_stride_ * (height + 2)), kOutside);
  products_.resize(index(width + kCorrelationBlock));
  sums_.resize(index(width));
  sums2_.resize(index(width));
  for (int y = 0; y < height; ++y) {
    sum_columns(y, patch.side);
    const ScanRegion::Span& span = region.rows[index(y)];
    if (span.begin < span.end) score_row(patch, y, span, left);
  }
  for (int y = 0; y < height; ++y) {
    const float* scores = score_at_row(y);
    for (int x = 0; x < width; ++x) {
      if (scores[x] < kLeastPeak || !is_peak(scores + x)) continue;
      const Peak peak{left + x, region.top + y, static_cast<double>(scores[x])};
      const bool full = static_cast<int>(peaks.size()) == max_peaks;
      if (full && peak.score <= peaks.back().score) continue;
      if (full) peaks.pop_back();
      const auto place = std::upper_bound(peaks.begin(), peaks.end(), peak,
                                          [](const Peak& a, const Peak& b) { return a.score > b.score; });
      peaks.insert(place, peak);
    }
  }
  for (Peak& peak : peaks)
    peak.score = std::sqrt(peak.score);
}

double ZnccScan::score_at(const GrayImage& image, const Patch& patch, int x, int y) {
  const int half = patch.half();
  const double n = patch.side * patch.side;
  std::int32_t products = 0;
  std::int32_t sum = 0;
  std::int32_t sum2 = 0;
  for (int r = 0; r < patch.side; ++r) {
    const std::uint8_t* row = image.row(y - half + r) + x - half;
    const std::int16_t* t = patch.deviations.data() + index(r * Patch::kStride);
    for (int c = 0; c < patch.side; ++c) {
      const std::int32_t value = row[c] - patch.mean;
      products += t[c] * value;
      sum += value;
      sum2 += value * value;
    }
  }
  const double variation = n * sum2 - static_cast<double>(sum) * sum;
  if (variation < n * n) return 0.0;
  return (n * products - static_cast<double>(patch.sum) * sum) * patch.inverse_norm / std::sqrt(variation);
}

// Least squares of c + g.d + d.H.d / 2 to the nine scores around the peak; the top lies at -H^-1 g. The cross
// term matters: along a slanted edge the peak is a slanted ridge.
Eigen::Vector2d ZnccScan::refine(const GrayImage& image, const Patch& patch, const Peak& peak) {
  const int margin = patch.half() + 1;
  Eigen::Vector2d whole(peak.x, peak.y);
  if (peak.x < margin || peak.y < margin || peak.x > image.width - 1 - margin ||
      peak.y > image.height - 1 - margin) {
    return whole;
  }
  Eigen::Matrix3d score;  // row v, column u
  for (int v = 0; v < 3; ++v) {
    for (int u = 0; u < 3; ++u)
      score(v, u) = score_at(image, patch, peak.x + u - 1, peak.y + v - 1);
  }
  const Eigen::Vector2d gradient((score.col(2) - score.col(0)).sum() / 6.0,
                                 (score.row(2) - score.row(0)).sum() / 6.0);
  Eigen::Matrix2d curvature;
  curvature(0, 0) = (score.col(0) - 2.0 * score.col(1) + score.col(2)).sum() / 3.0;
  curvature(1, 1) = (score.row(0) - 2.0 * score.row(1) + score.row(2)).sum() / 3.0;
  curvature(0, 1) = 0.25 * (score(0, 0) + score(2, 2) - score(0, 2) - score(2, 0));
  curvature(1, 0) = curvature(0, 1);
  if (!(curvature(0, 0) < 0.0) || !(curvature.determinant() > 1e-12)) return whole;
  const Eigen::Vector2d offset = -(curvature.inverse() * gradient);
  return whole + offset.cwiseMax(-kMaxOffset).cwiseMin(kMaxOffset);
}

}  // namespace cosight::vision
