#pragma once

#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

#include "shared/dataset/known_point.hpp"
#include "shared/dataset/sample.hpp"
#include "shared/geometry/pose.hpp"
#include "sim/render/view_overlap.hpp"
#include "sim/scenario.hpp"

namespace cosight::sim {

/// The dataset folder cannot be written: names the file.
class DatasetError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A pose at a time, for truth files.
struct TimedPose {
  Stamp stamp = 0;
  Pose T;
};

/// A csv or text file that is complete on disk when it is closed, or else an error.
class TextFile {
 public:
  explicit TextFile(const std::filesystem::path& file);
  ~TextFile() = default;
  TextFile(const TextFile&) = delete;
  TextFile& operator=(const TextFile&) = delete;

  std::ofstream& stream() { return stream_; }
  void close();

 private:
  std::filesystem::path file_;
  std::ofstream stream_;
};

/// The files of a Cosight dataset folder: `robot/`, `wearer/` and `truth/` below `folder`. All throw
/// DatasetError.
void write_calibration(const std::filesystem::path& file, const CameraModel& lens, const Pose& T_BC);
void write_bytes(const std::filesystem::path& file, const std::vector<unsigned char>& bytes);
void write_image_list(const std::filesystem::path& file, const std::vector<Stamp>& stamps,
                      const std::vector<std::string>& names);
void write_tum(const std::filesystem::path& file, const std::vector<TimedPose>& poses);
void write_ahrs(const std::filesystem::path& file, const std::vector<AhrsSample>& samples);
void write_wearer_poses(const std::filesystem::path& file, const std::vector<WearerPoseSample>& samples);
void write_known_points(const std::filesystem::path& file, const std::vector<KnownPoint>& points);
void write_laser(const std::filesystem::path& file, const std::vector<LaserScan>& scans);
void write_laser_geometry(const std::filesystem::path& file,
                          const std::vector<std::pair<std::string, LaserPlan>>& lasers);
void write_imu(const std::filesystem::path& file, const std::vector<BiasedImuSample>& samples);
void write_imu_biases(const std::filesystem::path& file, const std::vector<BiasedImuSample>& samples);
void write_odometry(const std::filesystem::path& file, const std::vector<WheelOdometrySample>& rows);
void write_overlap(const std::filesystem::path& file, const std::vector<OverlapTruth>& overlap);

}  // namespace cosight::sim
