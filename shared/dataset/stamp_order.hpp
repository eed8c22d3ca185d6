#pragma once

#include <algorithm>
#include <vector>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Drops what is not newer than everything before it, and counts that and the gaps: intervals over three
/// times the median one.
template <class Row>
void keep_in_order(std::vector<Row>& rows, SourceCounters& counters) {
  std::vector<Stamp> intervals;
  std::vector<Row> kept;
  kept.reserve(rows.size());
  for (Row& row : rows) {
    if (!kept.empty() && row.stamp <= kept.back().stamp) {
      ++counters.stamp_went_back;
      continue;
    }
    if (!kept.empty()) intervals.push_back(row.stamp - kept.back().stamp);
    kept.push_back(std::move(row));
  }
  rows = std::move(kept);
  if (intervals.empty()) return;
  std::vector<Stamp> sorted = intervals;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  constexpr Stamp kGap = 3;
  counters.gaps += static_cast<std::uint64_t>(
      std::count_if(intervals.begin(), intervals.end(), [&](Stamp i) { return i > kGap * *middle; }));
}

}  // namespace cosight
