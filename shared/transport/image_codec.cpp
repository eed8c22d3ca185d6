#include <sensor_msgs.h>

#include <algorithm>
#include <string>
#include <utility>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

constexpr std::uint32_t kLargestSide = 16384;  // [px]

std::size_t pixels(std::uint32_t width, std::uint32_t height) {
  return std::size_t{width} * height;
}

Fault encode_raw(const ImageSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (sample.encoding != ImageEncoding::kMono8) return Fault::kEncoding;
  const auto width = static_cast<std::uint32_t>(std::max(sample.width, 0));
  const auto height = static_cast<std::uint32_t>(std::max(sample.height, 0));
  if (width == 0 || height == 0 || width > kLargestSide || height > kLargestSide) return Fault::kDimensions;
  if (sample.bytes.size() != pixels(width, height)) return Fault::kSize;

  sensor_msgs::msg::Image message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.height(height);
  message.width(width);
  message.encoding("mono8");
  message.is_bigendian(0);
  message.step(width);
  message.data(sample.bytes);
  return serialize(message, topic.max_bytes, payload);
}

Fault encode_compressed(const ImageSample& sample, const TopicProfile& topic,
                        std::vector<std::uint8_t>& payload) {
  if (sample.encoding == ImageEncoding::kMono8) return Fault::kEncoding;
  if (sample.bytes.empty()) return Fault::kSize;
  sensor_msgs::msg::CompressedImage message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.format(sample.encoding == ImageEncoding::kJpeg ? "jpeg" : "png");
  message.data(sample.bytes);
  return serialize(message, topic.max_bytes, payload);
}

// Rows may be padded on the wire (step > width), never in a sample.
void remove_padding(std::vector<std::uint8_t>& bytes, std::size_t width, std::size_t height,
                    std::size_t step) {
  if (step == width) return;
  for (std::size_t y = 1; y < height; ++y) {
    const auto row = bytes.begin() + static_cast<std::ptrdiff_t>(y * step);
    std::copy(row, row + static_cast<std::ptrdiff_t>(width),
              bytes.begin() + static_cast<std::ptrdiff_t>(y * width));
  }
  bytes.resize(width * height);
}

Fault decode_raw(std::span<const std::uint8_t> payload, const TopicProfile& topic, ImageSample& sample) {
  sensor_msgs::msg::Image message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.encoding() != "mono8" && message.encoding() != "8UC1") return Fault::kEncoding;
  const std::uint32_t width = message.width();
  const std::uint32_t height = message.height();
  if (width == 0 || height == 0 || width > kLargestSide || height > kLargestSide) return Fault::kDimensions;
  if (message.step() < width || pixels(message.step(), height) != message.data().size()) return Fault::kSize;

  sample.encoding = ImageEncoding::kMono8;
  sample.width = static_cast<int>(width);
  sample.height = static_cast<int>(height);
  sample.bytes = std::move(message.data());
  remove_padding(sample.bytes, width, height, message.step());
  return Fault::kNone;
}

// The format is "jpeg", or, from ROS 2's image transport, such as "mono8; jpeg compressed mono8".
Fault decode_format(const std::string& format, ImageEncoding& encoding) {
  if (format.size() > kLongestText) return Fault::kText;
  const bool jpeg = format.find("jpeg") != std::string::npos || format.find("jpg") != std::string::npos;
  const bool png = format.find("png") != std::string::npos;
  if (jpeg == png) return Fault::kEncoding;
  encoding = jpeg ? ImageEncoding::kJpeg : ImageEncoding::kPng;
  return Fault::kNone;
}

Fault decode_compressed(std::span<const std::uint8_t> payload, const TopicProfile& topic,
                        ImageSample& sample) {
  sensor_msgs::msg::CompressedImage message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (const Fault fault = decode_format(message.format(), sample.encoding); fault != Fault::kNone)
    return fault;
  if (message.data().empty()) return Fault::kSize;
  sample.width = 0;
  sample.height = 0;
  sample.bytes = std::move(message.data());
  return Fault::kNone;
}

}  // namespace

Fault encode(const ImageSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  return topic.kind == MessageKind::kImage ? encode_raw(sample, topic, payload)
                                           : encode_compressed(sample, topic, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, ImageSample& sample) {
  return topic.kind == MessageKind::kImage ? decode_raw(payload, topic, sample)
                                           : decode_compressed(payload, topic, sample);
}

}  // namespace cosight::transport
