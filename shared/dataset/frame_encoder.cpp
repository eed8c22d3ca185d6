#include "shared/dataset/frame_encoder.hpp"

#include "shared/image/image_header.hpp"

namespace cosight {

bool FrameEncoder::passes_unchanged(std::span<const std::uint8_t> bytes) const {
  const auto header = read_image_header(bytes);
  if (!header || !header->complete) return false;
  if (header->format == ImageFormat::kJpeg) {
    return output_.encoding == ImageEncoding::kJpeg && !output_.quality;
  }
  return output_.encoding == ImageEncoding::kPng;
}

DecodeOutcome FrameEncoder::encode(std::vector<std::uint8_t>&& bytes, ImageSample& sample) {
  const SizeLimits limits{.width = output_.width, .height = output_.height};
  if (!passes_unchanged(bytes)) {
    const DecodeOutcome outcome = decode_gray(bytes, limits, pixels_);
    return outcome == DecodeOutcome::kDecoded ? encode(pixels_, sample) : outcome;
  }
  const auto header = read_image_header(bytes);
  if (const auto verdict = judge_header(header, limits); verdict != DecodeOutcome::kDecoded) return verdict;
  sample.encoding = output_.encoding;
  sample.width = header->width;
  sample.height = header->height;
  sample.bytes = std::move(bytes);
  return DecodeOutcome::kDecoded;
}

DecodeOutcome FrameEncoder::encode(const GrayImage& image, ImageSample& sample) {
  if ((output_.width > 0 && image.width != output_.width) ||
      (output_.height > 0 && image.height != output_.height)) {
    return DecodeOutcome::kWrongSize;
  }
  sample.encoding = output_.encoding;
  sample.width = image.width;
  sample.height = image.height;
  switch (output_.encoding) {
    case ImageEncoding::kJpeg:
      encode_jpeg(image, output_.quality.value_or(FrameOutput::kUsualQuality), sample.bytes);
      break;
    case ImageEncoding::kPng:
      encode_png(image, sample.bytes);
      break;
    case ImageEncoding::kMono8:
      sample.bytes = image.data;
      break;
  }
  return DecodeOutcome::kDecoded;
}

}  // namespace cosight
