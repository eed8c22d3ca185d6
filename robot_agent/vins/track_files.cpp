#include "robot_agent/vins/track_files.hpp"

#include <fstream>
#include <sstream>
#include <string>
#include <utility>

#include "shared/evaluation/trajectory_reader.hpp"

namespace cosight::vins {
namespace {

std::ifstream open(const std::filesystem::path& file) {
  std::ifstream stream(file);
  if (!stream) throw TrackFileError(file.string() + ": cannot be opened");
  return stream;
}

TrackFileError bad_line(const std::filesystem::path& file, int line) {
  return TrackFileError(file.string() + ":" + std::to_string(line) + ": not a line of this format");
}

/// Seconds as text to nanoseconds without the rounding of a double.
Stamp parse_stamp(const std::string& text) {
  const std::size_t dot = text.find('.');
  std::string digits = dot == std::string::npos ? "" : text.substr(dot + 1);
  digits.resize(9, '0');
  return std::stoll(text.substr(0, dot)) * kNanosecondsPerSecond + std::stoll(digits);
}

void read_camera(const std::filesystem::path& file, TrackSequence& sequence) {
  std::ifstream stream = open(file);
  Eigen::Matrix3d R_BS;
  for (int i = 0; i < 9; ++i)
    stream >> R_BS(i / 3, i % 3);
  for (int i = 0; i < 3; ++i)
    stream >> sequence.T_BS.p(i);
  stream >> sequence.time_offset >> sequence.gravity;
  if (!stream) throw bad_line(file, 1);
  sequence.T_BS.q = Eigen::Quaterniond(R_BS).normalized();
}

void read_imu(const std::filesystem::path& file, TrackSequence& sequence) {
  std::ifstream stream = open(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::istringstream fields(line);
    std::string stamp;
    ImuSample sample;
    fields >> stamp;
    for (int i = 0; i < 3; ++i)
      fields >> sample.angular_velocity_B(i);
    for (int i = 0; i < 3; ++i)
      fields >> sample.acceleration_B(i);
    if (!fields) throw bad_line(file, number);
    sample.stamp = parse_stamp(stamp);
    sequence.imu.push_back(sample);
  }
}

void read_tracks(const std::filesystem::path& file, TrackSequence& sequence) {
  std::ifstream stream = open(file);
  std::string line;
  for (int number = 1; std::getline(stream, line); ++number) {
    std::istringstream fields(line);
    if (line.starts_with('F')) {
      std::string key;
      std::string stamp;
      fields >> key >> stamp;
      if (!fields) throw bad_line(file, number);
      sequence.frames.push_back({parse_stamp(stamp), {}});
      continue;
    }
    TrackedFeature feature;
    double u = 0.0;
    double v = 0.0;
    fields >> feature.id >> u >> v >> feature.sighting.point.x() >> feature.sighting.point.y();
    if (!fields || sequence.frames.empty()) throw bad_line(file, number);
    sequence.frames.back().features.push_back(feature);
  }
}

}  // namespace

TrackSequence read_track_sequence(const std::filesystem::path& folder) {
  TrackSequence sequence;
  read_camera(folder / "cam.txt", sequence);
  read_imu(folder / "imu.txt", sequence);
  read_tracks(folder / "tracks.txt", sequence);
  sequence.truth = read_trajectory(folder / "gt_tum.txt");
  if (sequence.truth.size() != sequence.frames.size()) {
    throw TrackFileError(folder.string() + ": " + std::to_string(sequence.frames.size()) + " frames but " +
                         std::to_string(sequence.truth.size()) + " true poses");
  }
  return sequence;
}

}  // namespace cosight::vins
