#include "shared/dataset/merged_source.hpp"

#include <utility>

namespace cosight {

MergedSource::MergedSource(std::vector<std::unique_ptr<SampleSource>> sources)
    : sources_(std::move(sources)) {
  for (const auto& source : sources_)
    heads_.push_back(source->next());
}

std::optional<Sample> MergedSource::next() {
  std::size_t first = sources_.size();
  for (std::size_t i = 0; i < heads_.size(); ++i) {
    if (!heads_[i]) continue;
    if (first == sources_.size() || stamp_of(*heads_[i]) < stamp_of(*heads_[first])) first = i;
  }
  if (first == sources_.size()) return std::nullopt;
  return std::exchange(heads_[first], sources_[first]->next());
}

SourceCounters MergedSource::counters(SampleKind kind) const {
  SourceCounters total;
  for (const auto& source : sources_)
    total += source->counters(kind);
  for (const auto& head : heads_) {
    if (head && kind_of(*head) == kind) --total.delivered;  // waits here, not delivered yet
  }
  return total;
}

std::string MergedSource::description() const {
  std::string text;
  for (const auto& source : sources_)
    text += (text.empty() ? "" : ", ") + source->description();
  return text;
}

}  // namespace cosight
