#pragma once

#include <Eigen/Core>
#include <array>
#include <cstdint>
#include <memory>
#include <vector>

#include "shared/geometry/convex_polygon.hpp"
#include "shared/image/gray_image.hpp"

namespace cosight::vision {

enum class DescriptorKind {
  kOrb,   ///< 256 bits; fastest
  kSift,  ///< 128 numbers; steadiest, slowest
  kSurf,  ///< 64 numbers
};

using BitDescriptor = std::array<std::uint64_t, 4>;
using VectorDescriptors = Eigen::Matrix<float, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;

/// Features of one image with their descriptors, either bits or vectors, row i for pixel i.
struct DescribedFeatures {
  std::vector<Eigen::Vector2d> pixels;
  std::vector<std::size_t> sources;  ///< which of the given pixels it is; 0, 1, … where it was detected
  std::vector<BitDescriptor> bits;
  VectorDescriptors vectors;

  std::size_t size() const { return pixels.size(); }
  bool is_binary() const { return vectors.size() == 0; }
};

/// Detects and describes features in the part of an image where the views overlap; touches no other part.
/// Keeps buffers: one per thread.
class DescriptorExtractor {
 public:
  DescriptorExtractor() = default;
  DescriptorExtractor(const DescriptorExtractor&) = delete;
  DescriptorExtractor& operator=(const DescriptorExtractor&) = delete;
  virtual ~DescriptorExtractor() = default;

  /// The strongest `max_features` inside `roi`, each at its own scale.
  virtual DescribedFeatures detect_and_describe(const GrayImage& image, const ConvexPolygon& roi,
                                                int max_features) = 0;

  /// Describes given pixels at the finest scale, so best compared with others described so. Those too near to
  /// the image's border are left out: see `sources`.
  virtual DescribedFeatures describe(const GrayImage& image, const std::vector<Eigen::Vector2d>& pixels) = 0;
};

std::unique_ptr<DescriptorExtractor> make_descriptor_extractor(DescriptorKind kind);

/// A region as a rectangle of whole pixels with a margin, inside the image; empty when they do not meet.
struct PixelBox {
  int left = 0, top = 0, width = 0, height = 0;
  bool empty() const { return width <= 0 || height <= 0; }
};
PixelBox pixel_box(const ConvexPolygon& roi, int margin, const GrayImage& image);

}  // namespace cosight::vision
