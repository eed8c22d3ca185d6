#include "shared/dataset/cosight_dataset.hpp"

#include <utility>

#include "shared/config/calibration.hpp"
#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/image_list_source.hpp"
#include "shared/dataset/merged_source.hpp"
#include "shared/dataset/robot_csv.hpp"

namespace cosight {
namespace {

std::unique_ptr<SampleSource> open_frames(const std::filesystem::path& csv, const CameraModel& camera,
                                          FrameOutput output) {
  output.width = camera.width;
  output.height = camera.height;
  return std::make_unique<ImageListSource>(read_image_csv(csv), output);
}

}  // namespace

CosightDataset::CosightDataset(std::filesystem::path folder) : folder_(std::move(folder)) {
  if (!std::filesystem::is_directory(folder_)) {
    throw DatasetError(folder_.string() + ": no such folder; make a dataset with sim or cosight prepare");
  }
}

bool CosightDataset::has_wearer() const {
  return std::filesystem::exists(folder_ / "wearer/cam0.csv");
}

bool CosightDataset::has_wearer_pose() const {
  return std::filesystem::exists(wearer_poses());
}

bool CosightDataset::has_imu() const {
  return std::filesystem::exists(folder_ / "robot/imu.csv");
}

CameraModel CosightDataset::robot_camera() const {
  return load_camera_model(robot_calibration());
}
CameraModel CosightDataset::wearer_camera() const {
  return load_camera_model(wearer_calibration());
}

std::optional<Pose> CosightDataset::T_BS() const {
  return load_body_extrinsics(robot_calibration());
}

std::vector<LaserMounting> CosightDataset::lasers() const {
  const auto yaml = folder_ / "robot/lasers.yaml";
  return std::filesystem::exists(yaml) ? read_laser_mountings(yaml) : std::vector<LaserMounting>{};
}

std::unique_ptr<SampleSource> CosightDataset::open_robot(FrameOutput output,
                                                         const WearerPoseNoise& noise) const {
  std::vector<std::unique_ptr<SampleSource>> sources;
  // What belongs to a frame comes before it, and odometry before the scans: who pairs them need not wait.
  const auto odometry = folder_ / "robot/odometry.csv";
  if (std::filesystem::exists(odometry)) sources.push_back(open_odometry_csv(odometry));
  const auto imu = folder_ / "robot/imu.csv";
  if (std::filesystem::exists(imu)) sources.push_back(open_imu_csv(imu));
  for (const LaserMounting& laser : lasers()) {
    const auto scans = folder_ / "robot" / (laser.laser + ".csv");
    if (std::filesystem::exists(scans)) sources.push_back(open_laser_csv(scans, laser));
  }
  if (has_wearer_pose()) sources.push_back(open_wearer_pose_csv(wearer_poses(), noise));
  sources.push_back(open_frames(folder_ / "robot/cam0.csv", robot_camera(), output));
  return std::make_unique<MergedSource>(std::move(sources));
}

std::unique_ptr<SampleSource> CosightDataset::open_wearer(FrameOutput output, const AhrsNoise& noise,
                                                          const std::vector<TimeInterval>& gate) const {
  auto frames = open_frames(folder_ / "wearer/cam0.csv", wearer_camera(), output);
  if (!gate.empty()) frames = std::make_unique<GatedSource>(std::move(frames), gate);
  const auto orientations = folder_ / "wearer/ahrs.csv";
  std::vector<std::unique_ptr<SampleSource>> sources;
  if (std::filesystem::exists(orientations)) sources.push_back(open_ahrs_csv(orientations, noise));
  sources.push_back(std::move(frames));
  return std::make_unique<MergedSource>(std::move(sources));
}

std::vector<KnownPoint> CosightDataset::known_points() const {
  const auto csv = folder_ / "robot/known_points.csv";
  return std::filesystem::exists(csv) ? read_known_points(csv) : std::vector<KnownPoint>{};
}

}  // namespace cosight
