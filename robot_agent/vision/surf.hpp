#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <vector>

#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// Sums over upright boxes of an image in four look-ups (Bay et al., section 3.1). Pixels beyond the border
/// count as nothing.
class IntegralImage {
 public:
  IntegralImage() = default;

  /// Of the part of `image` from (left, top) on; the whole part must lie in the image.
  void build(const GrayImage& image, int left, int top, int width, int height);

  int width() const { return width_; }
  int height() const { return height_; }

  /// Sum over columns x0 <= x < x1 and rows y0 <= y < y1, all within [0, width] and [0, height].
  std::int32_t sum(int x0, int y0, int x1, int y1) const {
    const std::int32_t* upper = row(y0);
    const std::int32_t* lower = row(y1);
    return lower[x1] - lower[x0] - upper[x1] + upper[x0];
  }
  std::int32_t clamped_sum(int x0, int y0, int x1, int y1) const;

  /// Sums over all rows above `y`: row(y)[x] over the columns before x. width + 1 values.
  const std::int32_t* row(int y) const {
    return sums_.data() + static_cast<std::ptrdiff_t>(y) * (width_ + 1);
  }

 private:
  int width_ = 0;
  int height_ = 0;
  std::vector<std::int32_t> sums_;
};

struct SurfOptions {
  double min_response = 2e-4;  ///< determinant of the Hessian of gray levels in [0, 1]
  int octaves = 3;             ///< 1 to 4; each doubles the size of the largest blobs
  bool upright = false;  ///< no orientation: faster and more distinct, but only up to 15 degrees of roll
};

struct SurfPoint {
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< in the integral image
  double scale = 1.6;                               ///< sigma of the blob [px]
  double angle = 0.0;                               ///< of its main gradient, x towards y [rad]
  double response = 0.0;
  bool bright = false;  ///< sign of the Laplacian: a bright blob on dark ground, or the other way
};

using SurfDescriptor = std::array<float, 64>;

/// Speeded-up robust features from the published algorithm (Bay, Ess, Tuytelaars, Van Gool, 2008): box
/// filters for the Hessian, Haar wavelets for orientation and descriptor. The descriptor's 4x4 regions
/// overlap (as in M-SURF), which makes it steadier against shifts. Keeps its buffers.
class Surf {
 public:
  explicit Surf(const SurfOptions& options = {});

  /// Blobs of the image, strongest first, orientation not yet set.
  const std::vector<SurfPoint>& detect(const IntegralImage& image);

  /// Angle of the main gradient around a point.
  double orientation(const IntegralImage& image, const SurfPoint& point) const;

  /// Of unit length; all zero where there is no texture.
  SurfDescriptor describe(const IntegralImage& image, const SurfPoint& point) const;

  const SurfOptions& options() const { return options_; }

 private:
  static constexpr int kGrid = 24;   ///< samples along a side of the descriptor's window
  static constexpr int kLayers = 4;  ///< filter sizes in an octave
  struct Layer {
    int filter = 0;  ///< side of the box filter [px]
    int step = 1;    ///< [px] between responses
    int width = 0;
    int height = 0;
    std::vector<float> response;
    std::vector<std::uint8_t> bright;
    float at(int x, int y) const {
      return response[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
                      static_cast<std::size_t>(x)];
    }
  };
  static void fill(const IntegralImage& image, Layer& layer);
  void find_maxima(int middle_layer);

  SurfOptions options_;
  std::array<Layer, kLayers> layers_;
  std::vector<SurfPoint> points_;
  std::array<float, 81> region_weights_{};  ///< Gaussian over one region's 9x9 samples
  std::array<float, 16> grid_weights_{};    ///< Gaussian over the 4x4 regions
};

}  // namespace cosight::vision
