#include <array>
#include <fstream>
#include <numbers>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/dataset/number_text.hpp"
#include "shared/evaluation/association.hpp"
#include "shared/evaluation/csv_table.hpp"
#include "shared/geometry/rotation.hpp"
#include "tools/prepare/prepare_error.hpp"
#include "tools/prepare/real_sequence.hpp"

namespace cosight {
namespace {

constexpr Stamp kFirstStamp = 1000 * kNanosecondsPerSecond;
constexpr double kTruthDelay = 0.29;  // t_image = t_truth + 0.29 s, estimated to 0.1 s
constexpr double kRadians = std::numbers::pi / 180.0;
constexpr Stamp kMaxDifference = 10'000'000;  // [ns]; the truth comes at 100 Hz

/// The tracker's axes are x left, y up, z ahead; W has x ahead, y left, z up.
Eigen::Quaterniond tracker_axes_in_W() {
  Eigen::Matrix3d R;
  R << 0, 0, 1,  //
      1, 0, 0,   //
      0, 1, 0;
  return Eigen::Quaterniond(R);
}

/// Pose of the camera from a row "t x y z rotX rotY rotZ" ([s], [m], [deg], R = Rx Ry Rz), as if the camera
/// sat where the markers are: the lever arm of a few cm is unknown.
StampedPose truth_row(const std::filesystem::path& path, int line_number, const std::string& line) {
  const auto parts = split_at_blanks(line);
  std::array<double, 7> row{};
  for (std::size_t i = 0; i < row.size(); ++i) {
    const auto value = parts.size() == row.size() ? parse_number(parts[i]) : std::nullopt;
    if (!value)
      throw PrepareError(path.string() + ":" + std::to_string(line_number) + ": is not seven numbers");
    row[i] = *value;
  }
  const Eigen::Quaterniond q_tracker = quaternion_exp({row[4] * kRadians, 0, 0}) *
                                       quaternion_exp({0, row[5] * kRadians, 0}) *
                                       quaternion_exp({0, 0, row[6] * kRadians});
  const Eigen::Quaterniond q_WT = tracker_axes_in_W();
  const Eigen::Quaterniond q_WB = q_WT * q_tracker * q_WT.conjugate();
  return {from_seconds(row[0] + kTruthDelay),
          {(q_WB * forward_looking_camera()).normalized(), q_WT * Eigen::Vector3d(row[1], row[2], row[3])}};
}

Trajectory read_truth(const std::filesystem::path& path) {
  std::ifstream file(path);
  if (!file) throw PrepareError(path.string() + ": cannot be opened");
  Trajectory truth;
  std::string line;
  for (int number = 1; std::getline(file, line); ++number) {
    if (trimmed(line).empty() || line.front() == '#') continue;
    truth.push_back(truth_row(path, number, line));
  }
  return truth;
}

}  // namespace

RealSequence read_tello(const std::filesystem::path& folder) {
  RealSequence sequence;
  sequence.robot_camera = load_camera_model(folder / "calib.yaml", "cam0");
  const CsvTable frames = CsvTable::read(folder / "cam0.csv");
  Trajectory image_times;
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    image_times.push_back({from_seconds(frames.number(row, "t_s")), {}});
  }
  const std::vector<PosePair> pairs =
      associate(image_times, read_truth(folder / "gt_optitrack.txt"), kMaxDifference);
  std::size_t next_pair = 0;
  for (std::size_t row = 0; row < frames.rows(); ++row) {
    const Stamp stamp = image_times[row].stamp;
    const bool has_truth = next_pair < pairs.size() && pairs[next_pair].stamp == stamp;
    sequence.robot_images.push_back({stamp + kFirstStamp,
                                     std::filesystem::canonical(folder / "cam0" / frames.text(row, "file")),
                                     has_truth ? std::optional(pairs[next_pair].T_WC_truth) : std::nullopt});
    if (has_truth) ++next_pair;
  }
  sequence.notes.emplace_back("truth: the markers, not the camera; its clock is known to 0.1 s only");
  return sequence;
}

}  // namespace cosight
