#include "shared/dataset/csv_lines.hpp"

#include <cctype>
#include <utility>

#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/number_text.hpp"

namespace cosight {
namespace {

bool is_header(std::string_view line) {
  if (line.starts_with('#')) return true;
  // "nan" and "inf" begin a broken row, not a header.
  const bool letter = std::isalpha(static_cast<unsigned char>(line[0])) != 0;
  return letter && !line.starts_with("nan") && !line.starts_with("NaN") && !line.starts_with("inf");
}

}  // namespace

CsvLines::CsvLines(std::filesystem::path file) : file_(std::move(file)), stream_(file_) {
  if (!stream_ || std::filesystem::is_directory(file_)) {
    throw DatasetError(file_.string() + ": can't be read; check the path");
  }
  auto content = next_content();
  if (content && is_header(*content)) {
    if (content->starts_with('#')) content->remove_prefix(1);
    for (const std::string_view cell : split_at_commas(*content))
      header_.emplace_back(cell);
    header_line_ = line_;
    do {
      content = next_content();
    } while (content && content->starts_with('#'));
  }
  if (!content) throw DatasetError(file_.string() + ": has no row");
  cells_ = split_at_commas(*content);
  first_waits_ = true;
}

std::optional<std::span<const std::string_view>> CsvLines::next() {
  if (std::exchange(first_waits_, false)) return cells_;
  while (const auto content = next_content()) {
    if (content->starts_with('#')) continue;
    cells_ = split_at_commas(*content);
    return cells_;
  }
  return std::nullopt;
}

/// The next line that is not empty, without the spaces around it.
std::optional<std::string_view> CsvLines::next_content() {
  while (std::getline(stream_, text_)) {
    ++line_;
    std::string_view content = trimmed(text_);
    if (line_ == 1 && content.starts_with("\xEF\xBB\xBF")) content.remove_prefix(3);  // a byte order mark
    if (!content.empty()) return content;
  }
  return std::nullopt;
}

}  // namespace cosight
