#pragma once

#include <filesystem>
#include <fstream>
#include <span>
#include <string>

namespace cosight::experiments {

/// A csv of numbers that gnuplot reads: one header line, then rows; "nan" where there is no number.
class CsvFile {
 public:
  /// Throws std::runtime_error when the file can't be made.
  CsvFile(const std::filesystem::path& path, const std::string& header);

  void row(std::span<const double> values);
  void row(std::initializer_list<double> values) { row(std::span(values.begin(), values.size())); }
  /// Throws std::runtime_error when not everything could be written.
  void close();

 private:
  std::filesystem::path path_;
  std::ofstream file_;
};

}  // namespace cosight::experiments
