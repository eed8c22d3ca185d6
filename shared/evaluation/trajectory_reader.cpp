#include "shared/evaluation/trajectory_reader.hpp"

#include <Eigen/LU>
#include <array>
#include <cmath>
#include <fstream>
#include <string>

#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/evaluation_error.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t kTumColumns = 8;
constexpr std::size_t kKittiColumns = 12;
constexpr double kMaxUnitDeviation = 1e-2;

/// A line of a file with its place, so that every complaint can name it.
struct Line {
  const fs::path& path;
  int number;
  std::string_view text;

  [[noreturn]] void reject(const std::string& reason) const {
    throw EvaluationError(path.string() + ":" + std::to_string(number) + ": " + reason);
  }
};

double number_at(const Line& line, const std::vector<std::string_view>& parts, std::size_t column) {
  const std::optional<double> value = parse_number(parts[column]);
  if (!value) {
    line.reject("column " + std::to_string(column + 1) + ", '" + std::string(parts[column]) +
                "', is not a finite number; remove the row or repair it");
  }
  return *value;
}

Eigen::Quaterniond unit(const Line& line, const Eigen::Quaterniond& q) {
  if (std::abs(q.norm() - 1.0) > kMaxUnitDeviation) {
    line.reject("the quaternion's length is " + std::to_string(q.norm()) +
                ", not 1; is the column order right?");
  }
  return q.normalized();
}

Eigen::Vector3d position_at(const Line& line, const std::vector<std::string_view>& parts) {
  return {number_at(line, parts, 1), number_at(line, parts, 2), number_at(line, parts, 3)};
}

StampedPose tum_row(const Line& line) {
  const std::vector<std::string_view> parts = split_at_blanks(line.text);
  if (parts.size() != kTumColumns) {
    line.reject("has " + std::to_string(parts.size()) + " columns, a TUM row has 8: t px py pz qx qy qz qw");
  }
  const std::optional<Stamp> stamp = parse_seconds(parts[0]);
  if (!stamp) line.reject("'" + std::string(parts[0]) + "' is not a time in seconds");
  const Eigen::Quaterniond q(number_at(line, parts, 7), number_at(line, parts, 4), number_at(line, parts, 5),
                             number_at(line, parts, 6));
  return {*stamp, {unit(line, q), position_at(line, parts)}};
}

StampedPose euroc_row(const Line& line) {
  const std::vector<std::string_view> parts = split_at_commas(line.text);
  if (parts.size() < kTumColumns) {
    line.reject("has " + std::to_string(parts.size()) +
                " columns, an EuRoC row has at least 8: t[ns], px, py, pz, qw, qx, qy, qz");
  }
  const std::optional<Stamp> stamp = parse_nanoseconds(parts[0]);
  if (!stamp) line.reject("'" + std::string(parts[0]) + "' is not a time in whole nanoseconds");
  const Eigen::Quaterniond q(number_at(line, parts, 4), number_at(line, parts, 5), number_at(line, parts, 6),
                             number_at(line, parts, 7));
  return {*stamp, {unit(line, q), position_at(line, parts)}};
}

Pose kitti_pose(const Line& line) {
  const std::vector<std::string_view> parts = split_at_blanks(line.text);
  if (parts.size() != kKittiColumns) {
    line.reject("has " + std::to_string(parts.size()) + " columns, a KITTI row has 12: the 3x4 matrix [R|p]");
  }
  Eigen::Matrix<double, 3, 4> T;
  for (std::size_t i = 0; i < kKittiColumns; ++i) {
    T(static_cast<int>(i / 4), static_cast<int>(i % 4)) = number_at(line, parts, i);
  }
  const Eigen::Matrix3d R = T.leftCols<3>();
  if (!(R * R.transpose()).isIdentity(kMaxUnitDeviation) || R.determinant() < 0.0) {
    line.reject("the left 3x3 block is not a rotation");
  }
  return {Eigen::Quaterniond(R).normalized(), T.col(3)};
}

/// Calls `take(line)` for each line that is neither empty nor a comment.
template <typename Take>
void for_each_line(const fs::path& path, Take take) {
  std::ifstream file(path);
  if (!file) throw EvaluationError(path.string() + ": cannot be opened; is the path right?");
  std::string text;
  for (int number = 1; std::getline(file, text); ++number) {
    const std::string_view content = trimmed(text);
    if (!content.empty() && content.front() != '#') take(Line{path, number, content});
  }
}

std::vector<Stamp> read_times(const fs::path& path) {
  std::vector<Stamp> stamps;
  for_each_line(path, [&](const Line& line) {
    const std::optional<Stamp> stamp = parse_seconds(line.text);
    if (!stamp) line.reject("'" + std::string(line.text) + "' is not a time in seconds");
    stamps.push_back(*stamp);
  });
  return stamps;
}

/// Gives KITTI rows, which carry no time, theirs.
class KittiClock {
 public:
  explicit KittiClock(const fs::path& times) : has_times_(!times.empty()) {
    if (has_times_) stamps_ = read_times(times);
  }

  Stamp stamp(const Line& line, std::size_t row) const {
    if (!has_times_) return static_cast<Stamp>(row) * kNanosecondsPerSecond;
    if (row >= stamps_.size()) {
      line.reject("row " + std::to_string(row + 1) + ", but the file of times has only " +
                  std::to_string(stamps_.size()));
    }
    return stamps_[row];
  }

 private:
  bool has_times_;
  std::vector<Stamp> stamps_;
};

StampedPose any_row(const Line& line, const KittiClock& clock, std::size_t row) {
  if (line.text.find(',') != std::string_view::npos) return euroc_row(line);
  if (split_at_blanks(line.text).size() == kKittiColumns) return {clock.stamp(line, row), kitti_pose(line)};
  return tum_row(line);
}

}  // namespace

Trajectory read_trajectory(const fs::path& path, const fs::path& kitti_times) {
  const KittiClock clock(kitti_times);
  Trajectory trajectory;
  for_each_line(path, [&](const Line& line) {
    const StampedPose pose = any_row(line, clock, trajectory.size());
    if (!trajectory.empty() && pose.stamp <= trajectory.back().stamp) {
      line.reject("the stamp " + seconds_text(pose.stamp) + " s is not later than the one before, " +
                  seconds_text(trajectory.back().stamp) + " s; sort the file and remove doubles");
    }
    trajectory.push_back(pose);
  });
  if (trajectory.empty()) throw EvaluationError(path.string() + ": holds no pose");
  return trajectory;
}

}  // namespace cosight
