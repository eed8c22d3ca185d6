#pragma once

#include <filesystem>
#include <fstream>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace cosight {

/// A csv line by line, one in memory. The first line is a header when it starts with `#` or a letter; later
/// lines that start with `#` and empty ones are skipped. Cells are text without the spaces around it.
class CsvLines {
 public:
  /// Throws DatasetError when the file can't be read or has no row.
  explicit CsvLines(std::filesystem::path file);

  /// Empty when there is none.
  const std::vector<std::string>& header() const { return header_; }
  int header_line() const { return header_line_; }

  /// What the first call of `next` gives, before it was made.
  std::span<const std::string_view> first_row() const { return cells_; }

  /// The cells of the next row, valid until the next call; nothing at the end.
  std::optional<std::span<const std::string_view>> next();

  /// Number of the line that `next` gave last, or of the first row.
  int line() const { return line_; }

 private:
  std::optional<std::string_view> next_content();

  std::filesystem::path file_;
  std::ifstream stream_;
  std::string text_;
  int line_ = 0;
  int header_line_ = 1;
  std::vector<std::string> header_;
  std::vector<std::string_view> cells_;
  bool first_waits_ = false;  ///< the first row is read, and `next` has not given it yet
};

}  // namespace cosight
