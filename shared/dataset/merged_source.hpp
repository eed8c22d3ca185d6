#pragma once

#include <vector>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Several sources as one, in the order of the stamps; of equal stamps the earlier source's comes first.
class MergedSource : public SampleSource {
 public:
  explicit MergedSource(std::vector<std::unique_ptr<SampleSource>> sources);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  std::vector<std::unique_ptr<SampleSource>> sources_;
  std::vector<std::optional<Sample>> heads_;  ///< the next sample of each
};

}  // namespace cosight
