#pragma once

#include <string_view>
#include <vector>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Seconds from the first image's stamp; the end does not belong to it.
struct TimeInterval {
  double from = 0.0;
  double to = 0.0;
};

/// "0:1.5,3:4.2"; nothing when it can't be read so, or an interval is empty or turned around.
std::optional<std::vector<TimeInterval>> parse_intervals(std::string_view text);

/// Lets images pass only inside the intervals, and everything else always: a wearer who looks away. An image
/// held back is no loss: the sequence numbers of those that pass have no holes for it.
class GatedSource : public SampleSource {
 public:
  GatedSource(std::unique_ptr<SampleSource> source, std::vector<TimeInterval> intervals);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  bool is_open(Stamp stamp) const;

  std::unique_ptr<SampleSource> source_;
  std::vector<TimeInterval> intervals_;
  std::optional<Stamp> origin_;
  std::uint64_t held_back_ = 0;
};

}  // namespace cosight
