#include "shared/evaluation/csv_table.hpp"

#include <fstream>

#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {

CsvTable CsvTable::read(const std::filesystem::path& path) {
  CsvTable table;
  table.path_ = path;
  std::ifstream file(path);
  std::string line;
  if (!file || !std::getline(file, line)) {
    throw EvaluationError(path.string() + ": cannot be opened, or has no header line");
  }
  std::string_view header = trimmed(line);
  while (header.starts_with('#'))
    header = trimmed(header.substr(1));
  for (const std::string_view name : split_at_commas(header)) {
    const std::size_t column = table.columns_.size();
    table.columns_.emplace(name, column);
  }
  for (int number = 2; std::getline(file, line); ++number) {
    if (!trimmed(line).empty()) table.read_row(line, number, file.eof());
  }
  return table;
}

void CsvTable::read_row(std::string_view line, int line_number, bool is_last) {
  const std::vector<std::string_view> parts = split_at_commas(line);
  if (parts.size() != columns_.size()) {
    if (is_last) return;
    throw EvaluationError(path_.string() + ":" + std::to_string(line_number) + ": has " +
                          std::to_string(parts.size()) + " columns, the header has " +
                          std::to_string(columns_.size()));
  }
  cells_.emplace_back(parts.begin(), parts.end());
  line_numbers_.push_back(line_number);
}

void CsvTable::reject(std::size_t row, const std::string& reason) const {
  throw EvaluationError(path_.string() + ":" + std::to_string(line_numbers_[row]) + ": " + reason);
}

const std::string& CsvTable::text(std::size_t row, const std::string& column) const {
  const auto found = columns_.find(column);
  if (found == columns_.end()) throw EvaluationError(path_.string() + ": has no column '" + column + "'");
  return cells_[row][found->second];
}

double CsvTable::number(std::size_t row, const std::string& column) const {
  const std::optional<double> value = parse_number(text(row, column));
  if (!value) reject(row, column + ": '" + text(row, column) + "' is not a finite number");
  return *value;
}

Stamp CsvTable::stamp(std::size_t row, const std::string& column) const {
  const std::optional<Stamp> value = parse_nanoseconds(text(row, column));
  if (!value) reject(row, column + ": '" + text(row, column) + "' is not a time in whole nanoseconds");
  return *value;
}

}  // namespace cosight
