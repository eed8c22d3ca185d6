#include "shared/dataset/gated_source.hpp"

#include <algorithm>
#include <utility>

#include "shared/dataset/csv_rows.hpp"
#include "shared/dataset/number_text.hpp"

namespace cosight {

std::optional<std::vector<TimeInterval>> parse_intervals(std::string_view text) {
  std::vector<TimeInterval> intervals;
  while (!text.empty()) {
    const auto comma = std::min(text.find(','), text.size());
    const std::string_view part = text.substr(0, comma);
    const auto colon = part.find(':');
    if (colon == std::string_view::npos) return std::nullopt;
    const auto from = parse_number(part.substr(0, colon));
    const auto to = parse_number(part.substr(colon + 1));
    if (!from || !to || *to <= *from) return std::nullopt;
    intervals.push_back({*from, *to});
    text.remove_prefix(std::min(comma + 1, text.size()));
  }
  return intervals;
}

GatedSource::GatedSource(std::unique_ptr<SampleSource> source, std::vector<TimeInterval> intervals)
    : source_(std::move(source)), intervals_(std::move(intervals)) {}

bool GatedSource::is_open(Stamp stamp) const {
  const double time = to_seconds(stamp - *origin_);
  return std::any_of(intervals_.begin(), intervals_.end(),
                     [&](const TimeInterval& i) { return time >= i.from && time < i.to; });
}

std::optional<Sample> GatedSource::next() {
  while (auto sample = source_->next()) {
    auto* const image = std::get_if<ImageSample>(&*sample);
    if (image == nullptr) return sample;
    if (!origin_) origin_ = image->stamp;
    if (is_open(image->stamp)) {
      image->sequence -= held_back_;
      return sample;
    }
    ++held_back_;
  }
  return std::nullopt;
}

SourceCounters GatedSource::counters(SampleKind kind) const {
  SourceCounters counters = source_->counters(kind);
  if (kind == SampleKind::kImage) counters.delivered -= held_back_;
  return counters;
}

std::string GatedSource::description() const {
  return source_->description() + ", images in " + std::to_string(intervals_.size()) + " intervals only";
}

}  // namespace cosight
