#include "tools/prepare/dataset_folder.hpp"

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iomanip>
#include <string>

#include "shared/config/calibration.hpp"
#include "shared/evaluation/trajectory_writer.hpp"
#include "tools/prepare/prepare_error.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;

/// A csv that complains when it could not be written.
class CsvFile {
 public:
  CsvFile(fs::path path, const std::string& header) : path_(std::move(path)), file_(path_) {
    file_ << header << '\n' << std::setprecision(12);
  }
  std::ofstream& row() { return file_; }
  void close() {
    file_.close();
    if (!file_) throw PrepareError(path_.string() + ": cannot be written; is the disk full?");
  }

 private:
  fs::path path_;
  std::ofstream file_;
};

void write_images(const fs::path& path, const std::vector<RecordedImage>& images) {
  CsvFile csv(path, "stamp_ns,file");
  for (const RecordedImage& image : images)
    csv.row() << image.stamp << ',' << image.file.string() << '\n';
  csv.close();
}

void write_quaternion(std::ostream& out, const Eigen::Quaterniond& q) {
  out << q.x() << ',' << q.y() << ',' << q.z() << ',' << q.w();
}

void write_truth(const fs::path& path, const std::vector<RecordedImage>& images, const std::string& comment) {
  Trajectory truth;
  for (const RecordedImage& image : images) {
    if (image.T_WC) truth.push_back({image.stamp, *image.T_WC});
  }
  if (!truth.empty()) write_trajectory(path, truth, TrajectoryFormat::kTum, comment);
}

const Pose& pose_at(const std::vector<RecordedImage>& images, Stamp stamp) {
  const auto found = std::find_if(images.begin(), images.end(), [&](const RecordedImage& image) {
    return image.stamp == stamp && image.T_WC;
  });
  if (found == images.end()) {
    throw PrepareError("the robot has no pose at the worn frame's stamp " + std::to_string(stamp));
  }
  return *found->T_WC;
}

void write_wearer_poses(const fs::path& path, const RealSequence& sequence, const DatasetNoise& noise) {
  CsvFile csv(path, "stamp_ns,px,py,pz,qx,qy,qz,qw,sigma_px,sigma_py,sigma_pz,sigma_rx,sigma_ry,sigma_rz");
  PoseNoiseSource source(noise.wearer_pose, noise.seed);
  for (const RecordedImage& image : sequence.wearer_images) {
    const Pose T_SF = pose_at(sequence.robot_images, image.stamp).inverse() * image.T_WC.value();
    const UncertainPose observed = source.observe(T_SF);
    csv.row() << image.stamp;
    for (const double coordinate : observed.T.p)
      csv.row() << ',' << coordinate;
    write_quaternion(csv.row() << ',', observed.T.q);
    for (const double variance : observed.covariance.diagonal())
      csv.row() << ',' << std::sqrt(variance);
    csv.row() << '\n';
  }
  csv.close();
}

/// The orientation of the wearer's head, which looks where its camera looks: q_WH = q_WF q_HF^-1.
void write_ahrs(const fs::path& path, const RealSequence& sequence, const DatasetNoise& noise) {
  CsvFile csv(path, "stamp_ns,qx,qy,qz,qw");
  PoseNoiseSource source({Eigen::Vector3d::Zero(), noise.ahrs_sigma}, noise.seed + 1);
  for (const RecordedImage& image : sequence.wearer_images) {
    const Eigen::Quaterniond q_WH = image.T_WC.value().q * forward_looking_camera().conjugate();
    const UncertainPose observed = source.observe({q_WH, Eigen::Vector3d::Zero()});
    csv.row() << image.stamp;
    write_quaternion(csv.row() << ',', observed.T.q);
    csv.row() << '\n';
  }
  csv.close();
}

void write_known_points(const fs::path& path, const std::vector<KnownPoint>& points) {
  CsvFile csv(path, "px,py,pz,u,v");
  for (const KnownPoint& point : points) {
    csv.row() << point.p_W.x() << ',' << point.p_W.y() << ',' << point.p_W.z() << ',';
    if (point.pixel) csv.row() << point.pixel->x() << ',' << point.pixel->y();
    if (!point.pixel) csv.row() << ',';
    csv.row() << '\n';
  }
  csv.close();
}

void write_wearer(const fs::path& folder, const RealSequence& sequence, const DatasetNoise& noise) {
  fs::create_directories(folder / "wearer");
  write_camera_model(folder / "wearer" / "calibration.yaml", sequence.wearer_camera);
  write_images(folder / "wearer" / "cam0.csv", sequence.wearer_images);
  write_ahrs(folder / "wearer" / "ahrs.csv", sequence, noise);
  write_wearer_poses(folder / "robot" / "wearer_pose.csv", sequence, noise);
  write_truth(folder / "truth" / "wearer_cam0.tum", sequence.wearer_images,
              "t px py pz qx qy qz qw: worn camera's optical frame in W");
}

}  // namespace

void write_dataset_folder(const fs::path& folder, const RealSequence& sequence, const DatasetNoise& noise) {
  fs::create_directories(folder / "robot");
  fs::create_directories(folder / "truth");
  write_camera_model(folder / "robot" / "calibration.yaml", sequence.robot_camera);
  write_images(folder / "robot" / "cam0.csv", sequence.robot_images);
  if (!sequence.known_points.empty()) {
    write_known_points(folder / "robot" / "known_points.csv", sequence.known_points);
  }
  write_truth(folder / "truth" / "robot_cam0.tum", sequence.robot_images,
              "t px py pz qx qy qz qw: robot camera's optical frame in W");
  if (!sequence.wearer_images.empty()) write_wearer(folder, sequence, noise);
}

}  // namespace cosight
