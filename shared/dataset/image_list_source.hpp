#pragma once

#include "shared/dataset/frame_encoder.hpp"
#include "shared/dataset/image_list.hpp"

namespace cosight {

/// Plays images from disk. A file that is missing, cut short, or of another size than the calibration says is
/// counted and skipped; its sequence number is left out, so that whoever counts sees the hole.
class ImageListSource : public SampleSource {
 public:
  ImageListSource(ImageList list, const FrameOutput& output);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override { return list_.description; }

 private:
  ImageList list_;
  FrameEncoder encoder_;
  std::size_t position_ = 0;
};

}  // namespace cosight
