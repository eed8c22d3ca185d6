#include "shared/evaluation/frame_log.hpp"

#include <string>

#include "shared/evaluation/csv_table.hpp"

namespace cosight {
namespace {

double number_or_zero(const CsvTable& table, std::size_t row, const std::string& column) {
  return table.has(column) ? table.number(row, column) : 0.0;
}

}  // namespace

std::vector<FrameRecord> read_frame_log(const std::filesystem::path& path) {
  const CsvTable table = CsvTable::read(path);
  std::vector<FrameRecord> records;
  records.reserve(table.rows());
  for (std::size_t row = 0; row < table.rows(); ++row) {
    FrameRecord record;
    record.stamp = table.stamp(row, "stamp_ns");
    record.pseudo_stereo =
        number_or_zero(table, row, "fused") + number_or_zero(table, row, "initialised") > 0.0;
    record.lost = table.has("tracking") && table.text(row, "tracking") == "lost";
    record.landmarks = number_or_zero(table, row, "landmarks");
    record.total_ms = number_or_zero(table, row, "total_ms");
    record.pseudo_stereo_ms =
        number_or_zero(table, row, "overlap_ms") + number_or_zero(table, row, "pseudo_stereo_ms");
    records.push_back(record);
  }
  return records;
}

}  // namespace cosight
