#include "shared/dataset/v4l2_source.hpp"

#include <algorithm>

#include "shared/dataset/v4l2_device.hpp"

namespace cosight {
namespace {

/// The gray image of a raw frame; false when there are too few bytes for it.
bool gray_of(std::span<const std::uint8_t> bytes, std::uint32_t pixel_format, int width, int height,
             std::size_t bytes_per_row, GrayImage& image) {
  const std::size_t bytes_per_pixel = pixel_format == V4L2_PIX_FMT_YUYV ? 2 : 1;
  bytes_per_row = std::max(bytes_per_row, static_cast<std::size_t>(width) * bytes_per_pixel);
  if (bytes.size() < bytes_per_row * static_cast<std::size_t>(height)) return false;
  if (bytes_per_pixel == 2) {
    gray_of_yuyv(bytes.data(), width, height, bytes_per_row, image);
    return true;
  }
  image.width = width;
  image.height = height;
  image.data.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    std::copy_n(bytes.data() + static_cast<std::size_t>(y) * bytes_per_row, width, image.row(y));
  }
  return true;
}

}  // namespace

void gray_of_yuyv(const std::uint8_t* yuyv, int width, int height, std::size_t bytes_per_row,
                  GrayImage& image) {
  image.width = width;
  image.height = height;
  image.data.resize(static_cast<std::size_t>(width) * static_cast<std::size_t>(height));
  for (int y = 0; y < height; ++y) {
    const std::uint8_t* const packed = yuyv + static_cast<std::size_t>(y) * bytes_per_row;
    std::uint8_t* const gray = image.row(y);
    for (std::size_t x = 0; x < static_cast<std::size_t>(width); ++x)
      gray[x] = packed[2 * x];
  }
}

V4l2Source::V4l2Source(const V4l2Options& options, const FrameOutput& output, const std::atomic<bool>& stop)
    : device_(std::make_unique<Device>(options)), encoder_(output), stop_(stop) {}

V4l2Source::~V4l2Source() = default;

std::optional<Sample> V4l2Source::next() {
  std::optional<Sample> next_sample;
  const auto take = [&](const Device::Frame& frame) {
    ImageSample sample;
    sample.stamp = frame.stamp;
    sample.sequence = frame.sequence;
    DecodeOutcome outcome = DecodeOutcome::kCorrupt;
    if (device_->pixel_format() == V4L2_PIX_FMT_MJPEG) {
      outcome = encoder_.encode({frame.bytes.begin(), frame.bytes.end()}, sample);
    } else if (gray_of(frame.bytes, device_->pixel_format(), device_->width(), device_->height(),
                       device_->bytes_per_row(), pixels_)) {
      outcome = encoder_.encode(pixels_, sample);
    }
    if (frame.damaged || outcome != DecodeOutcome::kDecoded) {
      ++(outcome == DecodeOutcome::kWrongSize ? counters_.wrong_size : counters_.unreadable);
    } else if (last_ && sample.stamp <= *last_) {
      ++counters_.stamp_went_back;
    } else {
      last_ = sample.stamp;
      ++counters_.delivered;
      next_sample = std::move(sample);
    }
  };
  while (!next_sample) {
    if (!device_->read(stop_, take)) break;
  }
  return next_sample;
}

SourceCounters V4l2Source::counters(SampleKind kind) const {
  return kind == SampleKind::kImage ? counters_ : SourceCounters{};
}

std::string V4l2Source::description() const {
  return "camera " + device_->name() + " (" + std::to_string(device_->width()) + "x" +
         std::to_string(device_->height()) + ")";
}

}  // namespace cosight
