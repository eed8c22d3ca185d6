#pragma once

#include <linux/videodev2.h>

#include <atomic>
#include <functional>
#include <span>
#include <string>
#include <vector>

#include "shared/dataset/v4l2_source.hpp"

namespace cosight {

/// A streaming V4L2 capture device with its memory-mapped buffers. Private to this room.
class V4l2Source::Device {
 public:
  explicit Device(const V4l2Options& options);
  ~Device();
  Device(const Device&) = delete;
  Device& operator=(const Device&) = delete;

  /// A frame as the driver gave it; the bytes are lent for the time of the call.
  struct Frame {
    std::span<const std::uint8_t> bytes;
    Stamp stamp = 0;
    std::uint64_t sequence = 0;
    bool damaged = false;
  };

  /// Waits for a frame and shows it; false once `stop` is set or the device is gone.
  bool read(const std::atomic<bool>& stop, const std::function<void(const Frame&)>& show);

  std::uint32_t pixel_format() const { return format_.fmt.pix.pixelformat; }
  int width() const { return static_cast<int>(format_.fmt.pix.width); }
  int height() const { return static_cast<int>(format_.fmt.pix.height); }
  std::size_t bytes_per_row() const { return format_.fmt.pix.bytesperline; }
  const std::string& name() const { return name_; }

 private:
  [[noreturn]] void fail(const std::string& sentence) const;
  void check_capabilities() const;
  void choose_format(const V4l2Options& options);
  void map_buffers();
  void close_device();
  int control(unsigned long request, void* argument) const;

  std::string name_;
  int file_ = -1;
  v4l2_format format_{};
  std::vector<std::span<std::uint8_t>> buffers_;
  Stamp monotonic_to_epoch_ = 0;
};

}  // namespace cosight
