#include "shared/dataset/motion_csv.hpp"

#include <array>
#include <cmath>
#include <utility>

#include "shared/dataset/csv_rows.hpp"
#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/number_text.hpp"
#include "shared/dataset/stamp_order.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

using Cells = std::span<const std::string>;

/// Fills `values` from the cells starting at `first`; false when one is missing or no finite number.
bool read_numbers(Cells cells, std::size_t first, std::span<double> values) {
  if (cells.size() < first + values.size()) return false;
  for (std::size_t i = 0; i < values.size(); ++i) {
    const auto value = parse_number(cells[first + i]);
    if (!value) return false;
    values[i] = *value;
  }
  return true;
}

Eigen::Vector3d vector(std::span<const double> xyz) {
  return {xyz[0], xyz[1], xyz[2]};
}

/// Of unit length, or nothing when it is too far from it to be a rounded one.
std::optional<Eigen::Quaterniond> quaternion(std::span<const double> xyzw) {
  const Eigen::Quaterniond q(xyzw[3], xyzw[0], xyzw[1], xyzw[2]);
  constexpr double kTolerance = 1e-2;
  if (std::abs(q.norm() - 1.0) > kTolerance) return std::nullopt;
  return q.normalized();
}

std::optional<AhrsSample> read_ahrs(Cells cells, const AhrsNoise& noise) {
  AhrsSample sample;
  const auto stamp = parse_nanoseconds(cells[0]);
  std::array<double, 4> xyzw{};
  if (!stamp || !read_numbers(cells, 1, xyzw)) return std::nullopt;
  const auto q_WH = quaternion(xyzw);
  if (!q_WH) return std::nullopt;
  sample.stamp = *stamp;
  sample.q_WH = *q_WH;
  std::array<double, 6> rates_and_forces{};
  if (cells.size() > 5) {
    if (!read_numbers(cells, 5, rates_and_forces)) return std::nullopt;
    sample.angular_velocity_H = vector(std::span(rates_and_forces).first(3));
    sample.acceleration_H = vector(std::span(rates_and_forces).last(3));
  }
  sample.orientation_covariance =
      Eigen::Vector3d(noise.tilt * noise.tilt, noise.tilt * noise.tilt, noise.yaw * noise.yaw).asDiagonal();
  return sample;
}

/// Six standard deviations or the 21 entries of the upper triangle, starting at the cell `first`.
bool read_covariance(Cells cells, std::size_t first, Eigen::Matrix<double, 6, 6>& covariance) {
  std::array<double, 21> values{};
  if (cells.size() == first + 6) {
    if (!read_numbers(cells, first, std::span(values).first(6))) return false;
    for (Eigen::Index i = 0; i < 6; ++i) {
      const double sigma = values[static_cast<std::size_t>(i)];
      covariance(i, i) = sigma * sigma;
    }
    return true;
  }
  if (!read_numbers(cells, first, values)) return false;
  std::size_t k = 0;
  for (Eigen::Index row = 0; row < 6; ++row) {
    for (Eigen::Index column = row; column < 6; ++column) {
      covariance(row, column) = covariance(column, row) = values[k++];
    }
  }
  return true;
}

std::optional<WearerPoseSample> read_wearer_pose(Cells cells, const WearerPoseNoise& noise) {
  constexpr std::size_t kPoseCells = 8;
  WearerPoseSample sample;
  const auto stamp = parse_nanoseconds(cells[0]);
  std::array<double, 3> position{};
  if (!stamp || cells.size() < kPoseCells || !read_numbers(cells, 1, position)) return std::nullopt;
  sample.stamp = *stamp;
  sample.T_SF.T.p = vector(position);
  sample.has_orientation = false;
  for (std::size_t i = 4; i < kPoseCells; ++i)
    sample.has_orientation |= !cells[i].empty();
  if (sample.has_orientation) {
    std::array<double, 4> xyzw{};
    if (!read_numbers(cells, 4, xyzw)) return std::nullopt;
    const auto q_SF = quaternion(xyzw);
    if (!q_SF) return std::nullopt;
    sample.T_SF.T.q = *q_SF;
  }
  auto& covariance = sample.T_SF.covariance;
  covariance.topLeftCorner<3, 3>().diagonal().setConstant(noise.position * noise.position);
  covariance.bottomRightCorner<3, 3>().diagonal().setConstant(noise.rotation * noise.rotation);
  if (cells.size() > kPoseCells && !read_covariance(cells, kPoseCells, covariance)) return std::nullopt;
  if (!is_valid(sample.T_SF)) return std::nullopt;
  return sample;
}

void check_columns(const CsvRows& rows, std::initializer_list<std::size_t> allowed, const char* expected) {
  const std::size_t columns = rows.header().empty() ? rows.row(0).size() : rows.header().size();
  for (const std::size_t count : allowed) {
    if (columns == count) return;
  }
  throw DatasetError((rows.header().empty() ? rows.place(0) : rows.header_place()) + ": has " +
                     std::to_string(columns) + " columns; expected is " + expected);
}

/// Reads all rows with `read`, counts what is dropped, and makes a source of the rest.
template <class Row, class Read>
std::unique_ptr<SampleSource> open_rows(const CsvRows& rows, const std::string& name, SampleKind kind,
                                        const Read& read) {
  SourceCounters dropped;
  std::vector<Row> samples;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    if (auto sample = read(rows.row(i))) {
      samples.push_back(std::move(*sample));
    } else {
      ++dropped.not_finite;
    }
  }
  keep_in_order(samples, dropped);
  if (samples.empty()) {
    throw DatasetError(rows.place(0) + ": neither this row nor any other can be used");
  }
  const std::string description = name + " (" + std::to_string(samples.size()) + " rows)";
  return std::make_unique<SampleListSource>(std::vector<Sample>(samples.begin(), samples.end()), kind,
                                            dropped, description);
}

}  // namespace

SampleListSource::SampleListSource(std::vector<Sample> samples, SampleKind kind,
                                   const SourceCounters& dropped, std::string description)
    : samples_(std::move(samples)), kind_(kind), counters_(dropped), description_(std::move(description)) {}

std::optional<Sample> SampleListSource::next() {
  if (position_ == samples_.size()) return std::nullopt;
  ++counters_.delivered;
  return std::move(samples_[position_++]);
}

SourceCounters SampleListSource::counters(SampleKind kind) const {
  return kind == kind_ ? counters_ : SourceCounters{};
}

std::unique_ptr<SampleSource> open_ahrs_csv(const std::filesystem::path& csv, const AhrsNoise& noise) {
  const CsvRows rows = CsvRows::read(csv);
  check_columns(rows, {5, 11}, "stamp_ns,qx,qy,qz,qw[,wx,wy,wz,ax,ay,az]");
  return open_rows<AhrsSample>(rows, "orientations " + csv.string(), SampleKind::kAhrs,
                               [&](Cells cells) { return read_ahrs(cells, noise); });
}

std::unique_ptr<SampleSource> open_wearer_pose_csv(const std::filesystem::path& csv,
                                                   const WearerPoseNoise& noise) {
  const CsvRows rows = CsvRows::read(csv);
  check_columns(rows, {8, 14, 29},
                "stamp_ns,px,py,pz,qx,qy,qz,qw and then nothing, 6 sigmas or 21 covariance entries");
  return open_rows<WearerPoseSample>(rows, "wearer poses " + csv.string(), SampleKind::kWearerPose,
                                     [&](Cells cells) { return read_wearer_pose(cells, noise); });
}

std::vector<KnownPoint> read_known_points(const std::filesystem::path& csv) {
  const CsvRows rows = CsvRows::read(csv);
  check_columns(rows, {3, 5}, "px,py,pz[,u,v]");
  std::vector<KnownPoint> points;
  for (std::size_t i = 0; i < rows.size(); ++i) {
    const Cells cells = rows.row(i);
    KnownPoint point;
    std::array<double, 3> position{};
    std::array<double, 2> pixel{};
    const bool has_pixel = cells.size() == 5 && !(cells[3].empty() && cells[4].empty());
    if (!read_numbers(cells, 0, position) || (has_pixel && !read_numbers(cells, 3, pixel))) {
      throw DatasetError(rows.place(i) + ": is no surveyed point; expected is px,py,pz[,u,v]");
    }
    point.p_W = vector(position);
    if (has_pixel) point.pixel = Eigen::Vector2d(pixel[0], pixel[1]);
    points.push_back(point);
  }
  return points;
}

}  // namespace cosight
