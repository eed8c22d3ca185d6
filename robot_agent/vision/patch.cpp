#include "robot_agent/vision/patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

#include "robot_agent/vision/index.hpp"

namespace cosight::vision {
namespace {

using GrayLevels = std::array<float, std::size_t{Patch::kMaxSide} * Patch::kMaxSide>;

/// A grid of pixels that can be read between and beyond them.
struct Raster {
  const std::uint8_t* data;
  int width;
  int height;

  bool holds(const Eigen::Vector2d& position) const {
    return position.x() >= 0.0 && position.y() >= 0.0 && position.x() < width - 1.0 &&
           position.y() < height - 1.0;
  }

  /// Beyond the border its gray level.
  float clamped_at(const Eigen::Vector2d& position) const {
    constexpr double kJustInside = 1e-6;
    return at({std::clamp(position.x(), 0.0, width - 1.0 - kJustInside),
               std::clamp(position.y(), 0.0, height - 1.0 - kJustInside)});
  }

  /// Of a position that it holds.
  float at(const Eigen::Vector2d& position) const {
    const int x = static_cast<int>(position.x());
    const int y = static_cast<int>(position.y());
    const auto fx = static_cast<float>(position.x() - x);
    const auto fy = static_cast<float>(position.y() - y);
    const std::uint8_t* upper = data + static_cast<std::ptrdiff_t>(y) * width + x;
    const std::uint8_t* lower = upper + width;
    const float above = static_cast<float>(upper[0]) + fx * static_cast<float>(upper[1] - upper[0]);
    const float below = static_cast<float>(lower[0]) + fx * static_cast<float>(lower[1] - lower[0]);
    return above + fy * (below - above);
  }
};

Patch make_patch(const GrayLevels& gray, int side) {
  const int n = side * side;
  int total = 0;
  std::array<int, std::size_t{Patch::kMaxSide} * Patch::kMaxSide> rounded;
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rounded[k] = static_cast<int>(std::lround(gray[k]));
    total += rounded[k];
  }
  Patch patch;
  patch.side = side;
  patch.mean = (2 * total + n) / (2 * n);
  double squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const int deviation = rounded[static_cast<std::size_t>(i)] - patch.mean;
    const auto k = index(i / side * Patch::kStride + i % side);
    patch.deviations[k] = static_cast<std::int16_t>(deviation);
    patch.sum += deviation;
    squares += deviation * deviation;
  }
  const double variation = n * squares - static_cast<double>(patch.sum) * patch.sum;
  // Under one gray level of standard deviation there is only noise to correlate.
  if (variation >= static_cast<double>(n) * n) patch.inverse_norm = 1.0 / std::sqrt(variation);
  return patch;
}

template <class GrayAt>
void sample_grid(const Eigen::Vector2d& centre, const Eigen::Matrix2d& B, int side, bool oversample,
                 GrayAt at, GrayLevels& gray) {
  const int half = side / 2;
  const Eigen::Vector2d diagonal = 0.25 * (B.col(0) + B.col(1));
  const Eigen::Vector2d antidiagonal = 0.25 * (B.col(0) - B.col(1));
  std::size_t i = 0;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx, ++i) {
      const Eigen::Vector2d position = centre + dx * B.col(0) + dy * B.col(1);
      gray[i] = oversample ? 0.25F * (at(position - diagonal) + at(position + diagonal) +
                                      at(position - antidiagonal) + at(position + antidiagonal))
                           : at(position);
    }
  }
}

/// Samples `raster` at centre + B [dx, dy]; with `oversample`, the mean of four points half a step apart.
Patch sample(const Raster& raster, const Eigen::Vector2d& centre, const Eigen::Matrix2d& B, int side,
             bool oversample) {
  assert(side % 2 == 1 && side <= Patch::kMaxSide);
  const double reach = 0.5 * side;
  const Eigen::Vector2d extent = reach * B.cwiseAbs().rowwise().sum();
  GrayLevels gray;
  if (raster.holds(centre - extent) && raster.holds(centre + extent)) {
    sample_grid(
        centre, B, side, oversample, [&](const Eigen::Vector2d& p) { return raster.at(p); }, gray);
  } else {
    sample_grid(
        centre, B, side, oversample, [&](const Eigen::Vector2d& p) { return raster.clamped_at(p); }, gray);
  }
  return make_patch(gray, side);
}

Raster raster_of(const ReferencePatch& reference) {
  return {reference.gray.data(), ReferencePatch::kSide, ReferencePatch::kSide};
}

bool is_usable_warp(const Eigen::Matrix2d& A) {
  constexpr double kMaxScale = 4.0;
  const double determinant = A.determinant();
  if (!(determinant > 1.0 / (kMaxScale * kMaxScale)) || !(determinant < kMaxScale * kMaxScale)) return false;
  return A.cwiseAbs().maxCoeff() <= kMaxScale;
}

}  // namespace

Patch cut_patch(const GrayImage& image, const Eigen::Vector2d& pixel, int side) {
  return sample({image.data.data(), image.width, image.height}, pixel, Eigen::Matrix2d::Identity(), side,
                false);
}

ReferencePatch cut_reference(const GrayImage& image, const Eigen::Vector2d& pixel) {
  ReferencePatch reference;
  reference.pixel = pixel;
  const int left = static_cast<int>(std::lround(pixel.x())) - ReferencePatch::kHalf;
  const int top = static_cast<int>(std::lround(pixel.y())) - ReferencePatch::kHalf;
  reference.centre = pixel - Eigen::Vector2d(left, top);
  std::size_t i = 0;
  for (int y = top; y < top + ReferencePatch::kSide; ++y) {
    const std::uint8_t* row = image.row(std::clamp(y, 0, image.height - 1));
    for (int x = left; x < left + ReferencePatch::kSide; ++x, ++i) {
      reference.gray[i] = row[std::clamp(x, 0, image.width - 1)];
    }
  }
  return reference;
}

std::optional<Patch> warp(const ReferencePatch& reference, const Eigen::Matrix2d& A, int side) {
  if (!is_usable_warp(A)) return std::nullopt;
  const Eigen::Matrix2d B = A.inverse();
  const bool shrinks = B.determinant() > 1.5 * 1.5;
  return sample(raster_of(reference), reference.centre, B, side, shrinks);
}

std::optional<PatchPyramid> warp_pyramid(const ReferencePatch& reference, const Eigen::Matrix2d& A,
                                         int side) {
  const std::optional<Patch> full = warp(reference, A, side);
  if (!full) return std::nullopt;
  return PatchPyramid{*full, sample(raster_of(reference), reference.centre, 2.0 * A.inverse(), side, true)};
}

double zncc(const Patch& a, const Patch& b) {
  assert(a.side == b.side);
  std::int32_t products = 0;
  for (std::size_t i = 0; i < a.deviations.size(); ++i)
    products += a.deviations[i] * b.deviations[i];
  const double n = a.side * a.side;
  return (n * products - static_cast<double>(a.sum) * b.sum) * a.inverse_norm * b.inverse_norm;
}

}  // namespace cosight::vision
