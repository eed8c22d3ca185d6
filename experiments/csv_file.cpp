#include "experiments/csv_file.hpp"

#include <stdexcept>

namespace cosight::experiments {

CsvFile::CsvFile(const std::filesystem::path& path, const std::string& header) : path_(path), file_(path) {
  file_ << header << '\n';
  if (!file_) throw std::runtime_error(path_.string() + ": cannot be written");
}

void CsvFile::row(std::span<const double> values) {
  for (std::size_t i = 0; i < values.size(); ++i)
    file_ << (i == 0 ? "" : ",") << values[i];
  file_ << '\n';
}

void CsvFile::close() {
  file_.close();
  if (!file_) throw std::runtime_error(path_.string() + ": cannot be written");
}

}  // namespace cosight::experiments
