#pragma once

#include <filesystem>
#include <functional>
#include <span>
#include <string>
#include <string_view>

#include "shared/dataset/csv_lines.hpp"
#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// Samples of one kind from a csv, read row by row as they are asked for: for files of any length. A row that
/// can't be used or does not go on in time is counted and skipped.
class CsvSource : public SampleSource {
 public:
  using Cells = std::span<const std::string_view>;
  using ReadRow = std::function<std::optional<Sample>(Cells)>;

  struct Format {
    SampleKind kind;
    std::size_t columns;   ///< of every row
    std::string expected;  ///< the columns, for whoever has others: "stamp_ns,wx,…"
  };

  /// Throws DatasetError when the file can't be read or its first line has another number of columns.
  CsvSource(const std::filesystem::path& csv, Format format, ReadRow read_row);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override { return csv_.string(); }

 private:
  bool follows(Stamp stamp);

  std::filesystem::path csv_;
  Format format_;
  ReadRow read_row_;
  CsvLines lines_;
  SourceCounters counters_;
  std::optional<Stamp> last_;
  double usual_interval_ = 0.0;  ///< a slow mean of those that were no gaps [ns]; 0: not known yet
};

}  // namespace cosight
