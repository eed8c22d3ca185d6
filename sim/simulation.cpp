#include "sim/simulation.hpp"

#include <array>
#include <cstdio>
#include <string>
#include <vector>

#include "sim/dataset_writer.hpp"
#include "sim/parallel.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;

std::string image_name(std::size_t frame) {
  std::array<char, 32> name{};
  std::snprintf(name.data(), name.size(), "%06zu.jpg", frame);
  return name.data();
}

void write_camera(const Carrier& carrier, const fs::path& folder) {
  write_calibration(folder / "calibration.yaml", carrier.camera.calibration(), carrier.plan.T_BC);
  std::vector<Stamp> stamps;
  std::vector<std::string> names;
  for (std::size_t k = 0; k < carrier.ticks.size(); ++k) {
    stamps.push_back(carrier.ticks[k].stamp);
    names.push_back("cam0/" + image_name(k));
  }
  write_image_list(folder / "cam0.csv", stamps, names);
}

std::vector<TimedPose> truth_of(const Carrier& carrier) {
  std::vector<TimedPose> poses;
  for (const Tick& tick : carrier.ticks)
    poses.push_back({tick.stamp, carrier.T_WC(tick.time)});
  return poses;
}

void write_sensors(const SimulatedRun& run, const fs::path& folder) {
  const fs::path robot = folder / "robot";
  write_wearer_poses(robot / "wearer_pose.csv", run.tracked_poses());
  write_ahrs(folder / "wearer/ahrs.csv", run.ahrs());
  write_laser(robot / "laser_front.csv", run.front_scans());
  write_laser(robot / "laser_rear.csv", run.rear_scans());
  write_laser_geometry(robot / "lasers.yaml",
                       {{"front", run.scenario().front_laser}, {"rear", run.scenario().rear_laser}});
  const std::vector<BiasedImuSample> imu = run.imu();
  write_imu(robot / "imu.csv", imu);
  write_imu_biases(folder / "truth/imu_bias.csv", imu);
  write_odometry(robot / "odometry.csv", run.odometry());
}

/// The bodies dense enough for any sensor of theirs, on the true clock.
void write_truth(const SimulatedRun& run, const fs::path& folder) {
  write_tum(folder / "robot_cam0.tum", truth_of(run.robot()));
  write_tum(folder / "wearer_cam0.tum", truth_of(run.wearer()));
  std::vector<TimedPose> robot;
  std::vector<TimedPose> head;
  for (const Tick& tick : ticks({.rate = 100.0}, run.world().duration(), RandomStream(0, "truth"))) {
    robot.push_back({tick.stamp, run.world().robot(tick.time)});
    head.push_back({tick.stamp, run.world().head(tick.time)});
  }
  write_tum(folder / "robot_body.tum", robot);
  write_tum(folder / "wearer_head.tum", head);
  write_overlap(folder / "overlap.csv", run.overlap());
}

std::size_t write_survey(const SimulatedRun& run, const fs::path& folder) {
  const std::vector<KnownPoint> points = run.known_points();
  const fs::path file = folder / "robot/known_points.csv";
  fs::remove(file);  // of an earlier run into the same folder: none is a dataset without a survey
  if (!points.empty()) write_known_points(file, points);
  return points.size();
}

/// Each frame is a job of its own, of either camera in turn: threads share nothing.
void write_frames(const SimulatedRun& run, const fs::path& folder, unsigned threads,
                  const std::atomic<bool>& stop) {
  for (const char* agent : {"robot", "wearer"})
    fs::create_directories(folder / agent / "cam0");
  struct Worker {
    Film robot, wearer;
  };
  const auto make_worker = [&] { return Worker{run.robot().film(), run.wearer().film()}; };
  const std::size_t robot_frames = run.robot().ticks.size();
  const auto work = [&](Worker& worker, std::size_t job) {
    if (stop) return;
    const bool is_robot = job < robot_frames;
    const Carrier& carrier = is_robot ? run.robot() : run.wearer();
    const std::size_t frame = is_robot ? job : job - robot_frames;
    const ImageSample sample = carrier.sample(is_robot ? worker.robot : worker.wearer, frame);
    write_bytes(folder / (is_robot ? "robot" : "wearer") / "cam0" / image_name(frame), sample.bytes);
  };
  for_each_job(robot_frames + run.wearer().ticks.size(), threads, make_worker, work);
}

}  // namespace

RunReport write_dataset(const SimulatedRun& run, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  RunReport report{
      run.robot().ticks.size(), run.wearer().ticks.size(), 0, run.world().duration(), 0.0, false};
  write_camera(run.robot(), folder / "robot");
  write_camera(run.wearer(), folder / "wearer");
  write_sensors(run, folder);
  write_truth(run, folder / "truth");
  report.overlap_ratio = run.overlap_ratio();
  report.known_points = write_survey(run, folder);
  if (options.with_frames) write_frames(run, folder, options.threads, stop);
  report.stopped = stop;
  return report;
}

RunReport write_dataset(const Scenario& scenario, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  return write_dataset(SimulatedRun(scenario, options.seed), options, folder, stop);
}

}  // namespace cosight::sim
