#pragma once

#include <filesystem>

#include "shared/dataset/frame_encoder.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// The frames of a video file, from stamp zero. Throws DatasetError when it can't be opened.
class VideoSource : public SampleSource {
 public:
  /// `rate_hz` 0: the stamps of the container, or its rate when it has none.
  VideoSource(const std::filesystem::path& file, double rate_hz, const FrameOutput& output);
  ~VideoSource() override;

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  class Decoder;  // OpenCV's

  std::unique_ptr<Decoder> decoder_;
  FrameEncoder encoder_;
  std::filesystem::path file_;
  double rate_hz_;
  GrayImage pixels_;
  SourceCounters counters_;
  std::uint64_t index_ = 0;
  std::optional<Stamp> last_;
};

}  // namespace cosight
