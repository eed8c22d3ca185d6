#include "shared/dataset/robot_csv.hpp"

#include <array>
#include <limits>

#include "shared/dataset/csv_source.hpp"
#include "shared/dataset/number_text.hpp"

namespace cosight {
namespace {

using Cells = CsvSource::Cells;

/// The stamp and the N finite numbers behind it.
template <std::size_t N>
struct NumberRow {
  Stamp stamp = 0;
  std::array<double, N> values{};
};

template <std::size_t N>
std::optional<NumberRow<N>> read_numbers(Cells cells) {
  NumberRow<N> row;
  const auto stamp = parse_nanoseconds(cells[0]);
  if (!stamp) return std::nullopt;
  row.stamp = *stamp;
  for (std::size_t i = 0; i < N; ++i) {
    const auto value = parse_number(cells[i + 1]);
    if (!value) return std::nullopt;
    row.values[i] = *value;
  }
  return row;
}

/// Nothing for what is neither a distance nor the word for none.
std::optional<float> read_range(std::string_view cell) {
  if (const auto value = parse_number(cell)) return static_cast<float>(*value);
  if (cell == "inf" || cell == "nan") return std::numeric_limits<float>::infinity();
  return std::nullopt;
}

std::optional<Sample> read_scan(Cells cells, const LaserMounting& laser) {
  const auto stamp = parse_nanoseconds(cells[0]);
  if (!stamp) return std::nullopt;
  LaserScanSample scan{.stamp = *stamp,
                       .laser = laser.laser,
                       .angle_min = static_cast<float>(laser.angle_min),
                       .angle_increment = static_cast<float>(laser.angle_increment),
                       .range_min = static_cast<float>(laser.range_min),
                       .range_max = static_cast<float>(laser.range_max),
                       .ranges = {}};
  scan.ranges.reserve(cells.size() - 1);
  for (const std::string_view cell : cells.subspan(1)) {
    const auto range = read_range(cell);
    if (!range) return std::nullopt;
    scan.ranges.push_back(*range);
  }
  return scan;
}

}  // namespace

std::unique_ptr<SampleSource> open_laser_csv(const std::filesystem::path& csv, const LaserMounting& laser) {
  const auto points = static_cast<std::size_t>(laser.points);
  return std::make_unique<CsvSource>(
      csv,
      CsvSource::Format{SampleKind::kLaserScan, points + 1,
                        "stamp_ns and " + std::to_string(points) + " ranges, as lasers.yaml says"},
      [laser](Cells cells) { return read_scan(cells, laser); });
}

std::unique_ptr<SampleSource> open_imu_csv(const std::filesystem::path& csv) {
  return std::make_unique<CsvSource>(csv,
                                     CsvSource::Format{SampleKind::kImu, 7, "stamp_ns,wx,wy,wz,ax,ay,az"},
                                     [](Cells cells) -> std::optional<Sample> {
                                       const auto row = read_numbers<6>(cells);
                                       if (!row) return std::nullopt;
                                       const auto& v = row->values;
                                       return ImuSample{row->stamp, {v[0], v[1], v[2]}, {v[3], v[4], v[5]}};
                                     });
}

std::unique_ptr<SampleSource> open_odometry_csv(const std::filesystem::path& csv) {
  return std::make_unique<CsvSource>(
      csv,
      CsvSource::Format{SampleKind::kWheelOdometry, 6, "stamp_ns,x_m,y_m,yaw_rad,speed_mps,turn_rate_radps"},
      [](Cells cells) -> std::optional<Sample> {
        const auto row = read_numbers<5>(cells);
        if (!row) return std::nullopt;
        const auto& v = row->values;
        return WheelOdometrySample{row->stamp, v[0], v[1], v[2], v[3], v[4]};
      });
}

}  // namespace cosight
