#include "shared/image/image_header.hpp"

#include <algorithm>
#include <array>
#include <cstddef>

namespace cosight {
namespace {

using Bytes = std::span<const std::uint8_t>;

std::uint32_t big_endian(Bytes bytes, std::size_t at, int count) {
  std::uint32_t value = 0;
  for (int i = 0; i < count; ++i)
    value = value << 8 | bytes[at + static_cast<std::size_t>(i)];
  return value;
}

// JPEG: 0xFF and a code, most of them followed by a length of two bytes that counts itself (ITU T.81, B.1).
constexpr std::uint8_t kStartOfImage = 0xD8;
constexpr std::uint8_t kEndOfImage = 0xD9;
constexpr std::uint8_t kStartOfScan = 0xDA;

bool is_frame_header(std::uint8_t code) {
  return code >= 0xC0 && code <= 0xCF && code != 0xC4 && code != 0xC8 && code != 0xCC;
}
bool stands_alone(std::uint8_t code) {
  return code == 0x01 || (code >= 0xD0 && code <= 0xD7);
}

/// Index of the code of the next marker at or after `at`; the size of `bytes` when there is none. Inside a
/// scan 0xFF00 is a byte of data, and restart markers belong to the data.
std::size_t next_marker(Bytes bytes, std::size_t at) {
  for (; at + 1 < bytes.size(); ++at) {
    if (bytes[at] != 0xFF) continue;
    const std::uint8_t code = bytes[at + 1];
    if (code != 0x00 && code != 0xFF && !stands_alone(code)) return at + 1;
  }
  return bytes.size();
}

std::optional<ImageHeader> read_jpeg_header(Bytes bytes) {
  std::optional<ImageHeader> header;
  for (std::size_t at = next_marker(bytes, 2); at < bytes.size(); at = next_marker(bytes, at)) {
    const std::uint8_t code = bytes[at];
    if (code == kEndOfImage) {
      if (header) header->complete = true;
      return header;
    }
    if (at + 3 > bytes.size()) return header;
    const std::size_t length = big_endian(bytes, at + 1, 2);
    if (length < 2) return std::nullopt;
    if (is_frame_header(code)) {
      if (length < 8 || at + 8 > bytes.size()) return std::nullopt;
      header = ImageHeader{.format = ImageFormat::kJpeg,
                           .width = static_cast<int>(big_endian(bytes, at + 6, 2)),
                           .height = static_cast<int>(big_endian(bytes, at + 4, 2))};
    }
    if (code == kStartOfScan && !header) return std::nullopt;
    at += 1 + length;
  }
  return header;
}

constexpr std::array<std::uint8_t, 8> kPngSignature = {0x89, 'P', 'N', 'G', '\r', '\n', 0x1A, '\n'};

/// PNG: chunks of a length, four letters, that many bytes, and a check sum of four bytes.
std::optional<ImageHeader> read_png_header(Bytes bytes) {
  constexpr std::uint32_t kIhdr = 0x49484452;
  constexpr std::uint32_t kIend = 0x49454E44;
  if (bytes.size() < 24 || big_endian(bytes, 12, 4) != kIhdr) return std::nullopt;
  const std::uint32_t width = big_endian(bytes, 16, 4);
  const std::uint32_t height = big_endian(bytes, 20, 4);
  if (std::max(width, height) > 0x7FFFFFFF) return std::nullopt;
  ImageHeader header{
      .format = ImageFormat::kPng, .width = static_cast<int>(width), .height = static_cast<int>(height)};
  for (std::size_t at = kPngSignature.size(); at + 12 <= bytes.size();) {
    const std::size_t length = big_endian(bytes, at, 4);
    if (length > bytes.size() - at - 12) break;
    header.complete = big_endian(bytes, at + 4, 4) == kIend;
    if (header.complete) break;
    at += 12 + length;
  }
  return header;
}

}  // namespace

std::optional<ImageHeader> read_image_header(Bytes bytes) {
  std::optional<ImageHeader> header;
  if (bytes.size() >= 4 && bytes[0] == 0xFF && bytes[1] == kStartOfImage) {
    header = read_jpeg_header(bytes);
  } else if (bytes.size() >= kPngSignature.size() &&
             std::equal(kPngSignature.begin(), kPngSignature.end(), bytes.begin())) {
    header = read_png_header(bytes);
  }
  if (header && (header->width <= 0 || header->height <= 0)) return std::nullopt;
  return header;
}

}  // namespace cosight
