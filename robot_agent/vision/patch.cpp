#include "robot_agent/vision/patch.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cassert>
#include <cmath>
#include <cstddef>

namespace cosight::vision {
namespace {

using GrayLevels = std::array<float, Patch::kMaxSide * Patch::kMaxSide>;

/// A grid of pixels that can be read between and beyond them.
struct Raster {
  const std::uint8_t* data;
  int width;
  int height;

  float at(const Eigen::Vector2d& position) const {
    const double x = std::clamp(position.x(), 0.0, static_cast<double>(width - 1));
    const double y = std::clamp(position.y(), 0.0, static_cast<double>(height - 1));
    const int x0 = std::min(static_cast<int>(x), std::max(width - 2, 0));
    const int y0 = std::min(static_cast<int>(y), std::max(height - 2, 0));
    const int x1 = std::min(x0 + 1, width - 1);
    const int y1 = std::min(y0 + 1, height - 1);
    const float fx = static_cast<float>(x - x0);
    const float fy = static_cast<float>(y - y0);
    const std::uint8_t* upper = data + static_cast<std::ptrdiff_t>(y0) * width;
    const std::uint8_t* lower = data + static_cast<std::ptrdiff_t>(y1) * width;
    const float above = static_cast<float>(upper[x0]) + fx * static_cast<float>(upper[x1] - upper[x0]);
    const float below = static_cast<float>(lower[x0]) + fx * static_cast<float>(lower[x1] - lower[x0]);
    return above + fy * (below - above);
  }
};

Patch make_patch(const GrayLevels& gray, int side) {
  const int n = side * side;
  int total = 0;
  std::array<int, Patch::kMaxSide * Patch::kMaxSide> rounded;
  for (int i = 0; i < n; ++i) {
    const auto k = static_cast<std::size_t>(i);
    rounded[k] = static_cast<int>(gray[k] + 0.5F);
    total += rounded[k];
  }
  Patch patch;
  patch.side = side;
  patch.mean = (2 * total + n) / (2 * n);
  double squares = 0.0;
  for (int i = 0; i < n; ++i) {
    const int deviation = rounded[static_cast<std::size_t>(i)] - patch.mean;
    const auto k = static_cast<std::size_t>(i / side * Patch::kStride + i % side);
    patch.deviations[k] = static_cast<std::int16_t>(deviation);
    patch.sum += deviation;
    squares += deviation * deviation;
  }
  const double variation = n * squares - static_cast<double>(patch.sum) * patch.sum;
  // Under one gray level of standard deviation there is only noise to correlate.
  if (variation >= static_cast<double>(n) * n) patch.inverse_norm = 1.0 / std::sqrt(variation);
  return patch;
}

/// Samples `raster` at centre + B [dx, dy]; with `oversample`, the mean of four points half a step apart.
Patch sample(const Raster& raster, const Eigen::Vector2d& centre, const Eigen::Matrix2d& B, int side,
             bool oversample) {
  assert(side % 2 == 1 && side <= Patch::kMaxSide);
  const int half = side / 2;
  const Eigen::Vector2d along_x = 0.25 * B.col(0);
  const Eigen::Vector2d along_y = 0.25 * B.col(1);
  GrayLevels gray;
  std::size_t i = 0;
  for (int dy = -half; dy <= half; ++dy) {
    for (int dx = -half; dx <= half; ++dx, ++i) {
      const Eigen::Vector2d position = centre + dx * B.col(0) + dy * B.col(1);
      gray[i] =
          oversample
              ? 0.25F * (raster.at(position - along_x - along_y) + raster.at(position + along_x - along_y) +
                         raster.at(position - along_x + along_y) + raster.at(position + along_x + along_y))
              : raster.at(position);
    }
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
