#include "sim/simulation.hpp"

#include <vector>

#include "sim/carrier_files.hpp"
#include "sim/dataset_writer.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;

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

void write_truth(const SimulatedRun& run, const fs::path& folder) {
  write_tum(folder / "robot_cam0.tum", truth_of(run.robot()));
  write_tum(folder / "wearer_cam0.tum", truth_of(run.wearer()));
  write_tum(folder / "robot_body.tum", truth_of(run.T_WB(), run.world().duration()));
  write_tum(folder / "wearer_head.tum", truth_of(run.T_WH(), run.world().duration()));
  write_overlap(folder / "overlap.csv", run.overlap());
}

std::size_t write_survey(const SimulatedRun& run, const fs::path& folder) {
  const std::vector<KnownPoint> points = run.known_points();
  const fs::path file = folder / "robot/known_points.csv";
  fs::remove(file);  // of an earlier run into the same folder: none is a dataset without a survey
  if (!points.empty()) write_known_points(file, points);
  return points.size();
}

}  // namespace

RunReport write_dataset(const SimulatedRun& run, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  RunReport report{
      run.robot().ticks.size(), run.wearer().ticks.size(), 0, run.world().duration(), 0.0, false};
  const std::vector<CarrierFolder> cameras{{run.robot(), folder / "robot"},
                                           {run.wearer(), folder / "wearer"}};
  for (const CarrierFolder& camera : cameras)
    write_camera(camera);
  write_sensors(run, folder);
  write_truth(run, folder / "truth");
  report.overlap_ratio = run.overlap_ratio();
  report.known_points = write_survey(run, folder);
  if (options.with_frames) write_frames(cameras, options.threads, stop);
  report.stopped = stop;
  return report;
}

RunReport write_dataset(const CityRun& run, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  const CarrierFolder camera{run.camera(), folder / "robot"};
  write_camera(camera);
  const std::vector<BiasedImuSample> imu = run.imu();
  write_imu(folder / "robot/imu.csv", imu);
  write_imu_biases(folder / "truth/imu_bias.csv", imu);
  write_tum(folder / "truth/robot_cam0.tum", truth_of(run.camera()));
  write_tum(folder / "truth/robot_body.tum", truth_of(run.T_WB(), run.duration()));
  if (options.with_frames) write_frames({camera}, options.threads, stop);
  RunReport report{.robot_frames = run.camera().ticks.size(), .duration = run.duration()};
  report.stopped = stop;
  return report;
}

RunReport write_dataset(const Scenario& scenario, const RunOptions& options, const fs::path& folder,
                        const std::atomic<bool>& stop) {
  return write_dataset(SimulatedRun(scenario, options.seed), options, folder, stop);
}

}  // namespace cosight::sim
