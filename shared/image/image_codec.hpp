#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <stdexcept>
#include <string>
#include <vector>

#include "shared/image/gray_image.hpp"
#include "shared/image/image_header.hpp"

namespace cosight {

/// How decoding went. Anything but kDecoded leaves the image's content unspecified.
enum class DecodeOutcome {
  kDecoded,
  kNotAnImage,  ///< neither JPEG nor PNG
  kTruncated,   ///< the end is missing: a file cut short, a transfer that broke off
  kTooLarge,    ///< more pixels than the limit
  kWrongSize,   ///< not the size that the calibration says
  kCorrupt,     ///< the header is good, the rest is not
};
const char* to_string(DecodeOutcome outcome);

/// Which sizes to accept; judged by the header, before anything is decoded or allocated.
struct SizeLimits {
  int width = 0;                         ///< [px]; 0: any
  int height = 0;                        ///< [px]; 0: any
  std::int64_t max_pixels = 64'000'000;  ///< about 8000 x 8000
};

/// What the header alone says about decoding: kDecoded when nothing speaks against it.
DecodeOutcome judge_header(const std::optional<ImageHeader>& header, const SizeLimits& limits);

/// Decodes a JPEG or PNG to gray. Never throws on bad bytes, and reuses the memory of `image` when it is of
/// the same size. An EXIF orientation is ignored: a calibration knows the sensor's own rows and columns.
DecodeOutcome decode_gray(std::span<const std::uint8_t> bytes, const SizeLimits& limits, GrayImage& image);

/// Replaces `bytes`; their memory is reused. `quality` 1…100.
void encode_jpeg(const GrayImage& image, int quality, std::vector<std::uint8_t>& bytes);

/// Lossless. `level` 0 (none) … 9 (smallest, slow); 1 is about as fast as JPEG.
void encode_png(const GrayImage& image, std::vector<std::uint8_t>& bytes, int level = 1);

/// A file that can't be read or written as an image; the message names it and says why.
class ImageFileError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// PNG or JPEG, by content.
GrayImage read_image(const std::filesystem::path& file);

/// By extension: `.jpg` and `.jpeg` with `quality`, everything else PNG.
void write_image(const std::filesystem::path& file, const GrayImage& image, int quality = 95);

/// The whole file, reusing the memory of `bytes`; false when it can't be read.
bool read_bytes(const std::filesystem::path& file, std::vector<std::uint8_t>& bytes);

}  // namespace cosight
