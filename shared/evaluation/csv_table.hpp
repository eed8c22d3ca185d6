#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "shared/dataset/stamp.hpp"

namespace cosight {

/// A csv with one header line ("stamp_ns,landmarks,…", a leading # is skipped), whole in memory.
class CsvTable {
 public:
  /// Throws EvaluationError when the file can't be opened or has no header, or where a row's number of
  /// columns differs from the header's (a last line cut short by a kill is dropped instead).
  static CsvTable read(const std::filesystem::path& path);

  std::size_t rows() const { return cells_.size(); }
  bool has(const std::string& column) const { return columns_.contains(column); }

  /// Throws EvaluationError with "file:line: …" when the column is missing or the cell is no such thing.
  const std::string& text(std::size_t row, const std::string& column) const;
  double number(std::size_t row, const std::string& column) const;
  Stamp stamp(std::size_t row, const std::string& column) const;

 private:
  [[noreturn]] void reject(std::size_t row, const std::string& reason) const;
  void read_row(std::string_view line, int line_number, bool is_last);

  std::filesystem::path path_;
  std::map<std::string, std::size_t> columns_;
  std::vector<std::vector<std::string>> cells_;
  std::vector<int> line_numbers_;
};

}  // namespace cosight
