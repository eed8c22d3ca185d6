#include "shared/dataset/agent_input.hpp"

#include <algorithm>
#include <numbers>
#include <utility>

#include "shared/config/calibration.hpp"
#include "shared/dataset/cosight_dataset.hpp"
#include "shared/dataset/dataset_error.hpp"
#include "shared/dataset/image_list_source.hpp"
#include "shared/dataset/merged_source.hpp"
#include "shared/dataset/robot_csv.hpp"
#include "shared/dataset/v4l2_source.hpp"
#include "shared/dataset/video_source.hpp"

namespace cosight {
namespace {

constexpr double kDegrees = std::numbers::pi / 180.0;

FrameOutput read_output(const ConfigNode& node) {
  FrameOutput output;
  output.encoding = node.choice(
      "encoding", output.encoding,
      {{"jpeg", ImageEncoding::kJpeg}, {"png", ImageEncoding::kPng}, {"raw", ImageEncoding::kMono8}});
  const int quality = node.integer("quality", 0, 0, 100);
  if (quality > 0) output.quality = quality;
  return output;
}

double read_sigma(const ConfigNode& node, const char* key, double otherwise) {
  return node.number(key, otherwise / kDegrees, 1e-3, 180.0) * kDegrees;
}

void read_wearer_options(const ConfigNode& node, InputOptions& options) {
  options.ahrs = node.path("ahrs", options.ahrs);
  options.ahrs_noise.tilt = read_sigma(node, "ahrs_tilt_sigma_deg", options.ahrs_noise.tilt);
  options.ahrs_noise.yaw = read_sigma(node, "ahrs_yaw_sigma_deg", options.ahrs_noise.yaw);
  const auto gate = parse_intervals(node.text("gate", ""));
  if (!gate) throw node.error("gate", "is no list of seconds; write it as 0:1.5,3:4.2");
  options.gate = *gate;
}

void read_robot_options(const ConfigNode& node, InputOptions& options) {
  options.topics = node.boolean("topics", options.topics);
  options.recording = node.path("recording", options.recording);
  options.end_after = node.number("end_after_s", options.end_after, 0.0, 86'400.0);
  auto& noise = options.wearer_pose_noise;
  options.wearer_pose = node.path("wearer_pose", options.wearer_pose);
  noise.position = node.number("wearer_position_sigma_m", noise.position, 1e-5, 100.0);
  noise.rotation = read_sigma(node, "wearer_rotation_sigma_deg", noise.rotation);
  RobotFiles& robot = options.robot;
  robot.lasers = node.path("lasers", robot.lasers);
  robot.laser_front = node.path("laser_front", robot.laser_front);
  robot.laser_rear = node.path("laser_rear", robot.laser_rear);
  robot.odometry = node.path("odometry", robot.odometry);
  robot.imu = node.path("imu", robot.imu);
  robot.known_points = node.path("known_points", robot.known_points);
  const bool has_scans = !robot.laser_front.empty() || !robot.laser_rear.empty();
  if (has_scans && robot.lasers.empty()) {
    throw node.error("lasers", "is missing; scans can't be read without the yaml of their lasers");
  }
}

void require_one_source(const ConfigNode& node, const InputOptions& options, Agent agent) {
  const bool described_only = options.topics || !options.recording.empty();
  const auto given = {!options.dataset.empty() && !described_only,
                      !options.images.empty(),
                      !options.video.empty(),
                      !options.device.empty(),
                      options.topics,
                      !options.recording.empty()};
  const auto count = std::count(given.begin(), given.end(), true);
  if (count == 1) return;
  throw node.error(count == 0 ? "dataset" : "images",
                   "give " + std::string(count == 0 ? "one" : "only one") + " of dataset, images, video" +
                       (agent == Agent::kRobot ? ", device, topics and recording" : " and device") +
                       " (--dataset DIR is the simplest)");
}

/// EuRoC's sensor.yaml lies beside data.csv.
std::filesystem::path calibration_of(const InputOptions& options) {
  if (!options.calibration.empty()) return options.calibration;
  for (const char* beside :
       {"mav0/cam0/sensor.yaml", "cam0/sensor.yaml", "sensor.yaml", "calibration.yaml"}) {
    auto file = options.images / beside;
    if (!options.images.empty() && std::filesystem::exists(file)) return file;
  }
  throw ConfigError("input.calibration: is missing; give the yaml file with the camera's calibration");
}

AgentInput prepare_dataset(const InputOptions& options, Agent agent) {
  const CosightDataset dataset(options.dataset);
  AgentInput input;
  if (agent == Agent::kRobot) {
    input.camera = dataset.robot_camera();
    input.known_points = dataset.known_points();
    input.has_wearer_pose = dataset.has_wearer_pose();
    input.has_imu = dataset.has_imu();
    input.T_BS = dataset.T_BS();
    input.lasers = dataset.lasers();
    input.open = [dataset, options] { return dataset.open_robot(options.output, options.wearer_pose_noise); };
  } else {
    input.camera = dataset.wearer_camera();
    input.open = [dataset, options] {
      return dataset.open_wearer(options.output, options.ahrs_noise, options.gate);
    };
  }
  return input;
}

/// What a robot's files say of how it is built. `calibration` may be empty.
AgentInput describe_robot(const InputOptions& options, const std::filesystem::path& calibration) {
  AgentInput input;
  const RobotFiles& files = options.robot;
  if (!calibration.empty()) {
    input.camera = load_camera_model(calibration, options.camera);
    input.T_BS = load_body_extrinsics(calibration, options.camera);
  }
  if (!files.lasers.empty()) input.lasers = read_laser_mountings(files.lasers);
  input.has_imu = !files.imu.empty();
  if (!files.known_points.empty()) input.known_points = read_known_points(files.known_points);
  return input;
}

/// The samples come by topics, or out of a recording of them.
AgentInput prepare_topics(const InputOptions& options) {
  AgentInput input = options.dataset.empty() ? describe_robot(options, options.calibration)
                                             : prepare_dataset(options, Agent::kRobot);
  input.open = nullptr;
  input.knows_camera = !options.dataset.empty() || !options.calibration.empty();
  input.live = true;
  input.has_wearer_pose = false;
  input.has_imu = true;
  return input;
}

std::unique_ptr<SampleSource> open_camera(const InputOptions& options, const FrameOutput& output,
                                          const std::atomic<bool>& stop) {
  if (!options.video.empty()) return std::make_unique<VideoSource>(options.video, options.rate_hz, output);
  if (options.device.empty()) {
    return std::make_unique<ImageListSource>(find_images(options.images, options.rate_hz), output);
  }
  V4l2Options camera;
  camera.device = options.device;
  camera.width = output.width;
  camera.height = output.height;
  if (options.rate_hz > 0.0) camera.rate_hz = options.rate_hz;
  return std::make_unique<V4l2Source>(camera, output, stop);
}

const LaserMounting& mounting_of(const std::string& name, const std::filesystem::path& yaml,
                                 const std::vector<LaserMounting>& lasers) {
  for (const LaserMounting& laser : lasers) {
    if (laser.laser == name) return laser;
  }
  throw ConfigError("input." + name + ": " + yaml.string() + " has no section " +
                    name.substr(name.find('_') + 1));
}

void open_robot_files(const RobotFiles& files, std::vector<std::unique_ptr<SampleSource>>& sources) {
  if (!files.odometry.empty()) sources.push_back(open_odometry_csv(files.odometry));
  if (!files.imu.empty()) sources.push_back(open_imu_csv(files.imu));
  if (files.lasers.empty()) return;
  const auto lasers = read_laser_mountings(files.lasers);
  for (const auto& [name, csv] :
       {std::pair{"laser_front", files.laser_front}, std::pair{"laser_rear", files.laser_rear}}) {
    if (!csv.empty()) sources.push_back(open_laser_csv(csv, mounting_of(name, files.lasers, lasers)));
  }
}

std::unique_ptr<SampleSource> open_parts(const InputOptions& options, const FrameOutput& output, Agent agent,
                                         const std::atomic<bool>& stop) {
  std::vector<std::unique_ptr<SampleSource>> sources;
  if (agent == Agent::kWearer && !options.ahrs.empty()) {
    sources.push_back(open_ahrs_csv(options.ahrs, options.ahrs_noise));
  }
  if (agent == Agent::kRobot) open_robot_files(options.robot, sources);
  if (agent == Agent::kRobot && !options.wearer_pose.empty()) {
    sources.push_back(open_wearer_pose_csv(options.wearer_pose, options.wearer_pose_noise));
  }
  auto frames = open_camera(options, output, stop);
  if (!options.gate.empty()) frames = std::make_unique<GatedSource>(std::move(frames), options.gate);
  if (sources.empty()) return frames;
  sources.push_back(std::move(frames));
  return std::make_unique<MergedSource>(std::move(sources));
}

}  // namespace

InputOptions read_input_options(const ConfigNode& node, Agent agent) {
  InputOptions options;
  options.dataset = node.path("dataset", options.dataset);
  options.images = node.path("images", options.images);
  options.video = node.path("video", options.video);
  options.device = node.path("device", options.device);
  options.calibration = node.path("calibration", options.calibration);
  options.camera = node.text("camera", options.camera);
  options.rate_hz = node.number("rate_hz", options.rate_hz, 0.0, 1000.0);
  if (agent == Agent::kWearer) {
    read_wearer_options(node, options);
  } else {
    read_robot_options(node, options);
  }
  options.output = read_output(node);
  require_one_source(node, options, agent);
  return options;
}

AgentInput prepare_input(const InputOptions& options, Agent agent, const std::atomic<bool>& stop) {
  if (options.topics || !options.recording.empty()) return prepare_topics(options);
  AgentInput input;
  if (!options.dataset.empty()) {
    input = prepare_dataset(options, agent);
  } else {
    const auto calibration = calibration_of(options);
    if (agent == Agent::kRobot) {
      input = describe_robot(options, calibration);
    } else {
      input.camera = load_camera_model(calibration, options.camera);
    }
    FrameOutput output = options.output;
    output.width = input.camera.width;
    output.height = input.camera.height;
    input.live = !options.device.empty();
    input.has_wearer_pose = agent == Agent::kRobot && !options.wearer_pose.empty();
    input.open = [options, output, agent, &stop] { return open_parts(options, output, agent, stop); };
  }
  if (!input.live) input.open();  // so that a fault shows now, not in the thread that plays
  return input;
}

}  // namespace cosight
