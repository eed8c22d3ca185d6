#include "robot_agent/inbox/frame_decoder.hpp"

#include "shared/image/image_codec.hpp"

namespace cosight::inbox {
namespace {

bool fits(int actual, int expected) {
  return expected == 0 || actual == expected;
}

DecodedFrame from_mono8(const ImageSample& frame, const ImageSize& expected) {
  if (!fits(frame.width, expected.width) || !fits(frame.height, expected.height)) return {nullptr, true};
  if (frame.width <= 0 || frame.height <= 0) return {};
  const auto pixels = static_cast<std::uint64_t>(frame.width) * static_cast<std::uint64_t>(frame.height);
  if (frame.bytes.size() != pixels) return {};
  return {std::make_shared<const GrayImage>(GrayImage{frame.width, frame.height, frame.bytes}), false};
}

}  // namespace

DecodedFrame decode_frame(const ImageSample& frame, const ImageSize& expected) {
  if (frame.encoding == ImageEncoding::kMono8) return from_mono8(frame, expected);
  const SizeLimits limits{.width = expected.width, .height = expected.height};
  auto image = std::make_shared<GrayImage>();
  const DecodeOutcome outcome = decode_gray(frame.bytes, limits, *image);
  if (outcome == DecodeOutcome::kDecoded) return {std::move(image), false};
  return {nullptr, outcome == DecodeOutcome::kWrongSize || outcome == DecodeOutcome::kTooLarge};
}

}  // namespace cosight::inbox
