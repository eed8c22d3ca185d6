#pragma once

#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "shared/dataset/stamp.hpp"

namespace cosight {

/// The rows of a csv (csv_lines.hpp), each with its line number; whole in memory. What the cells mean, and
/// what to do with a bad one, is the reader's business.
class CsvRows {
 public:
  /// Throws DatasetError when the file can't be read or has no row.
  static CsvRows read(const std::filesystem::path& file);

  std::size_t size() const { return rows_.size(); }
  std::span<const std::string> header() const { return header_; }
  std::span<const std::string> row(std::size_t index) const { return rows_[index].cells; }

  /// Column of that name, compared without its unit: "timestamp" is found as "timestamp [ns]".
  std::optional<std::size_t> column(std::string_view name) const;

  /// "cam0.csv:12", of a row or of the header.
  std::string place(std::size_t index) const;
  std::string header_place() const;

 private:
  struct Row {
    int line = 0;
    std::vector<std::string> cells;
  };

  std::filesystem::path file_;
  int header_line_ = 1;
  std::vector<std::string> header_;
  std::vector<Row> rows_;
};

}  // namespace cosight
