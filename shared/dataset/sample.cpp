#include "shared/dataset/sample.hpp"

#include "shared/dataset/sample_source.hpp"

namespace cosight {

Stamp stamp_of(const Sample& sample) {
  return std::visit([](const auto& s) { return s.stamp; }, sample);
}

SourceCounters& SourceCounters::operator+=(const SourceCounters& other) {
  delivered += other.delivered;
  unreadable += other.unreadable;
  wrong_size += other.wrong_size;
  not_finite += other.not_finite;
  stamp_went_back += other.stamp_went_back;
  gaps += other.gaps;
  return *this;
}

SourceCounters SampleSource::counters() const {
  SourceCounters total;
  for (std::size_t kind = 0; kind < kSampleKinds; ++kind)
    total += counters(static_cast<SampleKind>(kind));
  return total;
}

}  // namespace cosight
