#pragma once

#include <atomic>
#include <filesystem>

#include "shared/dataset/frame_encoder.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

struct V4l2Options {
  std::filesystem::path device = "/dev/video0";
  int width = 640;        ///< [px]
  int height = 480;       ///< [px]
  double rate_hz = 30.0;  ///< asked of the driver, which may choose another
};

/// A camera of the machine, read through the kernel's own interface: a camera's JPEGs pass unchanged when
/// JPEG is wanted, stamps are the driver's (of the exposure's end, on the clock of this machine since the
/// epoch), and frames that the driver dropped leave holes in the sequence numbers. Throws DatasetError when
/// the device is missing, is no camera, or has none of MJPEG, GREY and YUYV at that size.
class V4l2Source : public SampleSource {
 public:
  /// `next` gives nothing once `stop` is set, or the camera has been unplugged.
  V4l2Source(const V4l2Options& options, const FrameOutput& output, const std::atomic<bool>& stop);
  ~V4l2Source() override;

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  class Device;

  std::unique_ptr<Device> device_;
  FrameEncoder encoder_;
  const std::atomic<bool>& stop_;
  GrayImage pixels_;
  SourceCounters counters_;
  std::optional<Stamp> last_;
};

/// The brightness of a packed YUYV image whose rows are `bytes_per_row` long.
void gray_of_yuyv(const std::uint8_t* yuyv, int width, int height, std::size_t bytes_per_row,
                  GrayImage& image);

}  // namespace cosight
