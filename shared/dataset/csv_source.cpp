#include "shared/dataset/csv_source.hpp"

#include <utility>

#include "shared/dataset/dataset_error.hpp"

namespace cosight {

CsvSource::CsvSource(const std::filesystem::path& csv, Format format, ReadRow read_row)
    : csv_(csv), format_(std::move(format)), read_row_(std::move(read_row)), lines_(csv) {
  const bool has_header = !lines_.header().empty();
  const std::size_t columns = has_header ? lines_.header().size() : lines_.first_row().size();
  if (columns == format_.columns) return;
  throw DatasetError(csv.string() + ":" + std::to_string(has_header ? lines_.header_line() : lines_.line()) +
                     ": has " + std::to_string(columns) + " columns; expected is " + format_.expected);
}

std::optional<Sample> CsvSource::next() {
  while (const auto cells = lines_.next()) {
    auto sample = cells->size() == format_.columns ? read_row_(*cells) : std::nullopt;
    if (!sample) {
      ++counters_.not_finite;
    } else if (!follows(stamp_of(*sample))) {
      ++counters_.stamp_went_back;
    } else {
      ++counters_.delivered;
      return sample;
    }
  }
  return std::nullopt;
}

bool CsvSource::follows(Stamp stamp) {
  if (!last_) {
    last_ = stamp;
    return true;
  }
  if (stamp <= *last_) return false;
  const auto interval = static_cast<double>(stamp - *std::exchange(last_, stamp));
  constexpr double kGap = 3.0;
  constexpr double kNewShare = 0.1;
  const bool is_gap = usual_interval_ > 0.0 && interval > kGap * usual_interval_;
  if (is_gap) {
    ++counters_.gaps;
  } else {
    usual_interval_ =
        usual_interval_ > 0.0 ? usual_interval_ + kNewShare * (interval - usual_interval_) : interval;
  }
  return true;
}

SourceCounters CsvSource::counters(SampleKind kind) const {
  return kind == format_.kind ? counters_ : SourceCounters{};
}

}  // namespace cosight
