#include "shared/dataset/csv_rows.hpp"

#include "shared/dataset/csv_lines.hpp"
#include "shared/dataset/number_text.hpp"

namespace cosight {
namespace {

std::string_view without_unit(std::string_view name) {
  return trimmed(name.substr(0, name.find('[')));
}

}  // namespace

CsvRows CsvRows::read(const std::filesystem::path& file) {
  CsvLines lines(file);
  CsvRows rows;
  rows.file_ = file;
  rows.header_ = lines.header();
  rows.header_line_ = lines.header_line();
  while (const auto cells = lines.next()) {
    rows.rows_.push_back({lines.line(), {cells->begin(), cells->end()}});
  }
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
