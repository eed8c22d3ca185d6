#include "tools/recording_export.hpp"

#include <fstream>
#include <optional>
#include <string>
#include <variant>

#include "shared/config/calibration.hpp"
#include "shared/evaluation/trajectory_writer.hpp"
#include "shared/image/image_codec.hpp"
#include "shared/recording/recording_error.hpp"
#include "shared/recording/recording_source.hpp"
#include "shared/transport/codec.hpp"
#include "shared/transport/topics.hpp"

namespace cosight {
namespace {

namespace fs = std::filesystem;
using recording::RecordedEvent;
using recording::RecordingError;

constexpr int kDigits = 17;

const char* name_of(Agent agent) {
  return agent == Agent::kRobot ? "robot" : "wearer";
}

void write_file(const fs::path& path, std::span<const std::uint8_t> bytes) {
  std::ofstream file(path, std::ios::binary);
  file.write(reinterpret_cast<const char*>(bytes.data()), static_cast<std::streamsize>(bytes.size()));
  file.close();
  if (!file) throw RecordingError(path.string() + " can't be written");
}

/// Writes the frame below `folder`, as STAMP.jpg or STAMP.png; returns the file's name.
std::string write_frame(const fs::path& folder, const ImageSample& frame) {
  const bool is_jpeg = frame.encoding == ImageEncoding::kJpeg;
  const std::string name = std::to_string(frame.stamp) + (is_jpeg ? ".jpg" : ".png");
  if (frame.encoding != ImageEncoding::kMono8) {
    write_file(folder / name, frame.bytes);
    return name;
  }
  GrayImage image;
  image.width = frame.width;
  image.height = frame.height;
  image.data = frame.bytes;
  std::vector<std::uint8_t> png;
  encode_png(image, png);
  write_file(folder / name, png);
  return name;
}

/// One agent's folder in EuRoC's form.
class EurocFolder {
 public:
  explicit EurocFolder(const fs::path& folder) : camera_(folder / "mav0/cam0"), imu_(folder / "mav0/imu0") {}

  void add(const ImageSample& frame) {
    open(frames_, camera_, "#timestamp [ns],filename");
    fs::create_directories(camera_ / "data");
    frames_ << frame.stamp << ',' << write_frame(camera_ / "data", frame) << '\n';
  }
  void add(Stamp stamp, const Eigen::Vector3d& omega, const Eigen::Vector3d& a) {
    open(inertial_, imu_,
         "#timestamp [ns],w_RS_S_x [rad s^-1],w_RS_S_y [rad s^-1],w_RS_S_z [rad s^-1],"
         "a_RS_S_x [m s^-2],a_RS_S_y [m s^-2],a_RS_S_z [m s^-2]");
    inertial_ << stamp;
    for (const Eigen::Vector3d& v : {omega, a})
      inertial_ << ',' << v.x() << ',' << v.y() << ',' << v.z();
    inertial_ << '\n';
  }
  void add(const CameraModel& camera) {
    fs::create_directories(camera_);
    write_camera_model(camera_ / "sensor.yaml", camera);
  }
  void close() {
    for (std::ofstream* file : {&frames_, &inertial_}) {
      if (!file->is_open()) continue;
      file->close();
      if (!*file) throw RecordingError(camera_.parent_path().string() + ": a csv file can't be written");
    }
  }

 private:
  static void open(std::ofstream& file, const fs::path& folder, const char* heading) {
    if (file.is_open()) return;
    fs::create_directories(folder);
    file.open(folder / "data.csv");
    file.precision(kDigits);
    file << heading << '\n';
  }

  fs::path camera_, imu_;
  std::ofstream frames_, inertial_;
};

void add_to(EurocFolder& folder, const RecordedEvent& event, Exported& exported) {
  if (const auto* const info = std::get_if<CameraInfoSample>(&event.content)) folder.add(info->camera);
  const auto* const sample = std::get_if<Sample>(&event.content);
  if (sample == nullptr) return;
  if (const auto* const frame = std::get_if<ImageSample>(sample)) {
    folder.add(*frame);
    ++exported.images;
  } else if (const auto* const imu = std::get_if<ImuSample>(sample)) {
    folder.add(imu->stamp, imu->angular_velocity_I, imu->acceleration_I);
    ++exported.rows;
  } else if (const auto* const ahrs = std::get_if<AhrsSample>(sample)) {
    folder.add(ahrs->stamp, ahrs->angular_velocity_H, ahrs->acceleration_H);
    ++exported.rows;
  }
}

/// The poses that a topic tells; `pose_of(sample)`.
template <class Kind, class PoseOf>
void export_trajectory(const recording::McapReader& reader, const transport::Topic<Kind>& topic,
                       const fs::path& path, const char* comment, PoseOf pose_of, Exported& exported) {
  recording::MessageFilter filter;
  filter.wants = [&topic](const recording::Channel& channel) {
    return "rt" + channel.topic == topic.profile.name;
  };
  Trajectory trajectory;
  auto cursor = reader.messages(filter, recording::MessageOrder::kFile);
  while (const auto message = cursor.next()) {
    Kind sample;
    if (transport::decode(message->payload, topic.profile, sample) == transport::Fault::kNone)
      trajectory.push_back({sample.stamp, pose_of(sample)});
    else
      ++exported.unusable;
  }
  if (trajectory.empty()) return;
  write_trajectory(path, trajectory, TrajectoryFormat::kTum, comment);
  exported.rows += trajectory.size();
}

}  // namespace

Exported export_euroc(const recording::McapReader& reader, const fs::path& folder) {
  EurocFolder robot(folder / name_of(Agent::kRobot));
  EurocFolder wearer(folder / name_of(Agent::kWearer));
  Exported exported;
  recording::RecordingSource source(reader);
  while (const auto event = source.next())
    add_to(event->from == Agent::kRobot ? robot : wearer, *event, exported);
  robot.close();
  wearer.close();
  exported.unusable = source.unusable();
  return exported;
}

Exported export_tum(const recording::McapReader& reader, const fs::path& folder) {
  fs::create_directories(folder);
  Exported exported;
  export_trajectory(
      reader, transport::topics::kRobotOdometry, folder / "robot.tum", "T_WS: t px py pz qx qy qz qw",
      [](const OdometrySample& sample) { return sample.T_WS.T; }, exported);
  export_trajectory(
      reader, transport::topics::kRobotWearerPose, folder / "wearer.tum", "T_SF: t px py pz qx qy qz qw",
      [](const WearerPoseSample& sample) { return sample.T_SF.T; }, exported);
  return exported;
}

Exported export_images(const recording::McapReader& reader, const fs::path& folder) {
  Exported exported;
  recording::RecordingSource source(reader);
  while (const auto event = source.next()) {
    const auto* const sample = std::get_if<Sample>(&event->content);
    const auto* const frame = sample == nullptr ? nullptr : std::get_if<ImageSample>(sample);
    if (frame == nullptr) continue;
    fs::create_directories(folder / name_of(event->from));
    write_frame(folder / name_of(event->from), *frame);
    ++exported.images;
  }
  exported.unusable = source.unusable();
  return exported;
}

}  // namespace cosight
