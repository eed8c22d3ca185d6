#include "shared/dataset/csv_rows.hpp"

#include <cctype>
#include <charconv>
#include <cmath>
#include <fstream>

#include "shared/dataset/dataset_error.hpp"

namespace cosight {
namespace {

std::string_view trim(std::string_view text) {
  const auto first = text.find_first_not_of(" \t\r");
  if (first == std::string_view::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

std::vector<std::string> split(std::string_view line) {
  std::vector<std::string> cells;
  for (std::size_t comma = 0; comma != std::string_view::npos;) {
    comma = line.find(',');
    cells.emplace_back(trim(line.substr(0, comma)));
    if (comma != std::string_view::npos) line.remove_prefix(comma + 1);
  }
  return cells;
}

bool is_header(std::string_view line) {
  if (line.starts_with('#')) return true;
  // "nan" and "inf" begin a broken row, not a header.
  const bool letter = std::isalpha(static_cast<unsigned char>(line[0])) != 0;
  return letter && !line.starts_with("nan") && !line.starts_with("NaN") && !line.starts_with("inf");
}

std::string_view without_unit(std::string_view name) {
  return trim(name.substr(0, name.find('[')));
}

}  // namespace

CsvRows CsvRows::read(const std::filesystem::path& file) {
  std::ifstream in(file);
  if (!in || std::filesystem::is_directory(file)) {
    throw DatasetError(file.string() + ": can't be read; check the path");
  }
  CsvRows rows;
  rows.file_ = file;
  std::string text;
  for (int line = 1; std::getline(in, text); ++line) {
    std::string_view content = trim(text);
    if (line == 1 && content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // a byte order mark
    if (content.empty()) continue;
    if (rows.rows_.empty() && rows.header_.empty() && is_header(content)) {
      if (content.starts_with('#')) content.remove_prefix(1);
      rows.header_ = split(content);
      rows.header_line_ = line;
    } else if (!content.starts_with('#')) {
      rows.rows_.push_back({line, split(content)});
    }
  }
  if (rows.rows_.empty()) throw DatasetError(file.string() + ": has no row");
  return rows;
}

std::optional<std::size_t> CsvRows::column(std::string_view name) const {
  for (std::size_t i = 0; i < header_.size(); ++i) {
    if (without_unit(header_[i]) == name) return i;
  }
  return std::nullopt;
}

std::string CsvRows::place(std::size_t index) const {
  return file_.string() + ":" + std::to_string(rows_[index].line);
}

std::string CsvRows::header_place() const {
  return file_.string() + ":" + std::to_string(header_line_);
}

}  // namespace cosight
