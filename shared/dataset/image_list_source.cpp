#include "shared/dataset/image_list_source.hpp"

#include <utility>

namespace cosight {

ImageListSource::ImageListSource(ImageList list, const FrameOutput& output)
    : list_(std::move(list)), encoder_(output) {}

std::optional<Sample> ImageListSource::next() {
  while (position_ < list_.entries.size()) {
    const ImageEntry& entry = list_.entries[position_++];
    ImageSample sample;
    sample.stamp = entry.stamp;
    sample.sequence = entry.sequence;
    std::vector<std::uint8_t> bytes;
    const DecodeOutcome outcome = read_bytes(entry.file, bytes) ? encoder_.encode(std::move(bytes), sample)
                                                                : DecodeOutcome::kNotAnImage;
    if (outcome == DecodeOutcome::kDecoded) {
      ++list_.counters.delivered;
      return sample;
    }
    const bool size = outcome == DecodeOutcome::kWrongSize || outcome == DecodeOutcome::kTooLarge;
    ++(size ? list_.counters.wrong_size : list_.counters.unreadable);
  }
  return std::nullopt;
}

SourceCounters ImageListSource::counters(SampleKind kind) const {
  return kind == SampleKind::kImage ? list_.counters : SourceCounters{};
}

}  // namespace cosight
