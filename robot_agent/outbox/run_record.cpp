#include "robot_agent/outbox/run_record.hpp"

#include <fstream>
#include <utility>

#include "robot_agent/map/map_files.hpp"
#include "robot_agent/outbox/frame_log.hpp"
#include "robot_agent/outbox/output_error.hpp"
#include "shared/program/process_usage.hpp"

namespace cosight::outbox {
namespace {

/// False when not everything went out.
bool write_text(const std::filesystem::path& path, const std::string& text) {
  std::ofstream file(path, std::ios::binary);
  file << text;
  file.close();
  return !file.fail();
}

}  // namespace

RunRecord::RunRecord(const RunFolder& folder, RunDescription description)
    : folder_(folder.path()), description_(std::move(description)) {
  if (description_.has_slam) {
    trajectory_.emplace(folder / "trajectory.tum").append("# T_WS: t[s] px py pz[m] qx qy qz qw");
    frames_.emplace(folder / "frames.csv").append(frame_log_header());
  }
  if (!write_text(folder / "config.yaml", description_.config)) {
    throw OutputError((folder / "config.yaml").string() + ": can't be written");
  }
}

void RunRecord::add(const FrameBundle& bundle, const FrameEstimate& estimate) {
  // Before the scale is known nothing is estimated: a pose then would claim that the robot stands still.
  if (estimate.tracking != Tracking::kWaitingForScale)
    trajectory_->append(trajectory_line(estimate.stamp, estimate.T_WS.T));
  frames_->append(frame_log_row(bundle, estimate));
  statistics_.add(bundle, estimate);
}

std::vector<std::string> RunRecord::finish(std::span<const MapPoint> map, double run_seconds,
                                           const Report& report) {
  std::vector<std::string> problems;
  for (auto* file : {&trajectory_, &frames_}) {
    if (!*file) continue;
    (*file)->close();
    if (const auto loss = (*file)->loss()) problems.push_back(*loss);
  }
  if (description_.has_slam) write_map(map, problems);
  const std::filesystem::path path = folder_ / "summary.yaml";
  if (!write_text(path, summary(map.size(), run_seconds, report))) {
    problems.push_back(path.string() + ": can't be written");
  }
  return problems;
}

void RunRecord::write_map(std::span<const MapPoint> map, std::vector<std::string>& problems) const {
  try {
    map::write_ply(folder_ / "map.ply", map);
    map::write_pcd(folder_ / "map.pcd", map);
  } catch (const map::MapFileError& error) {
    problems.emplace_back(error.what());
  }
}

std::string RunRecord::summary(std::size_t map_points, double run_seconds, const Report& report) const {
  const ProcessUsage usage = process_usage();
  YamlText text;
  text.value("version", description_.version).value("mode", description_.mode);
  text.value("run_s", run_seconds)
      .value("cpu_percent", run_seconds > 0.0 ? 100.0 * usage.cpu_seconds / run_seconds : 0.0)
      .value("peak_memory_mb", usage.peak_memory_mb);
  if (description_.has_slam) {
    text.value("map_points", static_cast<std::uint64_t>(map_points))
        .value("lost_lines", trajectory_->lost_lines() + frames_->lost_lines());
    statistics_.report(text);
  }
  if (report) report(text);
  return text.text();
}

}  // namespace cosight::outbox
