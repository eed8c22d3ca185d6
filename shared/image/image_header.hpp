#pragma once

#include <cstdint>
#include <optional>
#include <span>

namespace cosight {

enum class ImageFormat { kJpeg, kPng };

/// What the first bytes of an encoded image say, read without decoding: nothing is allocated for an image
/// that lies about its size.
struct ImageHeader {
  ImageFormat format = ImageFormat::kJpeg;
  int width = 0;   ///< [px]
  int height = 0;  ///< [px]
  /// The end marker is there. libjpeg fills what is missing with gray and only warns, so a truncated file has
  /// to be found here.
  bool complete = false;
};

/// Nothing when the bytes are neither a JPEG with a frame header (SOF) nor a PNG with IHDR.
std::optional<ImageHeader> read_image_header(std::span<const std::uint8_t> bytes);

}  // namespace cosight
