#pragma once

#include <optional>

#include "shared/dataset/sample.hpp"
#include "shared/image/image_codec.hpp"

namespace cosight {

/// How a source hands its frames on.
struct FrameOutput {
  ImageEncoding encoding = ImageEncoding::kJpeg;
  /// JPEG, 1…100. Nothing: what is a JPEG already passes unchanged, everything else gets kUsualQuality.
  std::optional<int> quality;
  int width = 0;   ///< what the calibration says [px]; 0: any
  int height = 0;  ///< [px]

  static constexpr int kUsualQuality = 90;
};

/// Brings frames into the encoding that is wanted, by the shortest way. Reuses its buffers.
class FrameEncoder {
 public:
  explicit FrameEncoder(const FrameOutput& output) : output_(output) {}

  /// Of an encoded frame. Anything but kDecoded leaves `sample` unspecified.
  DecodeOutcome encode(std::vector<std::uint8_t>&& bytes, ImageSample& sample);

  /// Of pixels.
  DecodeOutcome encode(const GrayImage& image, ImageSample& sample);

 private:
  bool passes_unchanged(std::span<const std::uint8_t> bytes) const;

  FrameOutput output_;
  GrayImage pixels_;
};

}  // namespace cosight
