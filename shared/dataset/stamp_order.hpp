#pragma once

#include <algorithm>
#include <vector>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Drops what is not newer than everything before it, and counts that and the gaps: intervals over three
/// times the median one. Of a row more than a second ahead of those around it, that row is what is dropped:
/// otherwise it would be the last.
template <class Row>
void keep_in_order(std::vector<Row>& rows, SourceCounters& counters) {
  constexpr Stamp kFarAhead = kNanosecondsPerSecond;
  std::vector<Row> kept;
  kept.reserve(rows.size());
  for (Row& row : rows) {
    if (!kept.empty() && row.stamp <= kept.back().stamp) {
      ++counters.stamp_went_back;
      const bool last_is_ahead = kept.size() > 1 && kept[kept.size() - 2].stamp < row.stamp &&
                                 kept.back().stamp - row.stamp > kFarAhead;
      if (last_is_ahead) kept.back() = std::move(row);
      continue;
    }
    kept.push_back(std::move(row));
  }
  rows = std::move(kept);
  std::vector<Stamp> intervals;
  for (std::size_t i = 1; i < rows.size(); ++i)
    intervals.push_back(rows[i].stamp - rows[i - 1].stamp);
  if (intervals.empty()) return;
  std::vector<Stamp> sorted = intervals;
  const auto middle = sorted.begin() + static_cast<std::ptrdiff_t>(sorted.size() / 2);
  std::nth_element(sorted.begin(), middle, sorted.end());
  constexpr Stamp kGap = 3;
  counters.gaps += static_cast<std::uint64_t>(
      std::count_if(intervals.begin(), intervals.end(), [&](Stamp i) { return i > kGap * *middle; }));
}

}  // namespace cosight
