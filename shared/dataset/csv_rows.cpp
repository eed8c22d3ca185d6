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

std::optional<double> parse_number(std::string_view text) {
  double value = 0.0;
  if (text.starts_with('+')) text.remove_prefix(1);
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size() || !std::isfinite(value)) return std::nullopt;
  return value;
}

std::optional<Stamp> parse_stamp_ns(std::string_view text) {
  Stamp value = 0;
  const auto [end, fault] = std::from_chars(text.data(), text.data() + text.size(), value);
  if (fault != std::errc() || end != text.data() + text.size()) return std::nullopt;
  return value;
}

std::optional<Stamp> parse_stamp_s(std::string_view text) {
  const auto point = text.find('.');
  const bool plain = text.find_first_of("eE-+") == std::string_view::npos;
  if (plain && point != std::string_view::npos && point > 0 && text.size() > point + 1) {
    std::string digits(text.substr(point + 1, 9));
    digits.resize(9, '0');
    const auto whole = parse_stamp_ns(text.substr(0, point));
    const auto fraction = parse_stamp_ns(digits);
    constexpr Stamp kMaxSeconds = 9'000'000'000;  // a nanosecond stamp ends in the year 2262
    if (!whole || !fraction || *whole > kMaxSeconds || !parse_number(text)) return std::nullopt;
    return *whole * kNanosecondsPerSecond + *fraction;
  }
  const auto seconds = parse_number(text);
  constexpr double kMaxSeconds = 9e9;
  if (!seconds || std::abs(*seconds) > kMaxSeconds) return std::nullopt;
  return from_seconds(*seconds);
}

}  // namespace cosight
