#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <cstdint>
#include <optional>

#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// A small square template, ready to be correlated (ZNCC). Rows are padded with zeros to a length that vector
/// instructions like; the rounded mean is taken off so that sums of products stay small integers.
struct Patch {
  static constexpr int kMaxSide = 15;
  static constexpr int kStride = 16;

  alignas(32) std::array<std::int16_t, std::size_t{kStride} * kMaxSide> deviations{};  ///< gray level - mean
  double inverse_norm = 0.0;  ///< 1 / sqrt(n sum(d^2) - sum(d)^2); 0 for a flat patch
  std::int32_t sum = 0;       ///< of the deviations: what the rounding of the mean left
  int side = 0;               ///< odd, at most kMaxSide [px]
  int mean = 0;               ///< rounded gray level

  int half() const { return side / 2; }
  bool is_flat() const { return inverse_norm == 0.0; }
};

/// The surroundings of a feature at its first sighting, large enough to be warped into later views.
struct ReferencePatch {
  static constexpr int kSide = 41;
  static constexpr int kHalf = kSide / 2;

  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();   ///< the feature in the image it was cut from
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();  ///< the same point in `gray` (column, row)
  std::array<std::uint8_t, std::size_t{kSide} * kSide>
      gray{};  ///< pixels outside the image repeat its border
};

/// A patch at full and at half resolution; the half one shows twice the area and serves the coarse search.
struct PatchPyramid {
  Patch full;
  Patch half;
};

/// The template around `pixel`, bilinear between pixels, border repeated. `side` odd.
Patch cut_patch(const GrayImage& image, const Eigen::Vector2d& pixel, int side);

ReferencePatch cut_reference(const GrayImage& image, const Eigen::Vector2d& pixel);

/// What the reference looks like where A = d pixel_present / d pixel_reference. Nothing when A is singular,
/// mirrors, or scales by more than four: such a patch would not correlate.
std::optional<Patch> warp(const ReferencePatch& reference, const Eigen::Matrix2d& A, int side);
std::optional<PatchPyramid> warp_pyramid(const ReferencePatch& reference, const Eigen::Matrix2d& A, int side);

/// Zero-normalised cross-correlation of two patches of one size, in [-1, 1]; 0 when one of them is flat.
double zncc(const Patch& a, const Patch& b);

}  // namespace cosight::vision
