#pragma once

#include <filesystem>
#include <functional>
#include <optional>
#include <span>
#include <string>
#include <vector>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/outbox/line_file.hpp"
#include "robot_agent/outbox/run_folder.hpp"
#include "robot_agent/outbox/run_statistics.hpp"
#include "robot_agent/outbox/yaml_text.hpp"

namespace cosight::outbox {

/// What a run was, for its summary.
struct RunDescription {
  std::string version;
  std::string mode;      ///< "collaborative", "mono"
  std::string config;    ///< everything that was set, as yaml
  bool has_slam = true;  ///< false: without the files and figures of slam
};

/// The files of one run: `config.yaml` at the start, `trajectory.tum` and `frames.csv` frame by frame,
/// `map.ply`, `map.pcd` and `summary.yaml` at the end. Without slam only the first and the last. A run that
/// is killed keeps every frame but the last.
class RunRecord {
 public:
  /// Throws OutputError when the folder can't be written.
  RunRecord(const RunFolder& folder, RunDescription description);

  void add(const FrameBundle& bundle, const FrameEstimate& estimate);

  /// Adds sections about the rest of the program: inbox, transport.
  using Report = std::function<void(YamlText&)>;

  /// Writes map and summary. Returns what could not be written, one sentence each: data was lost unless it is
  /// empty. `run_seconds`: wall time since the program's start, for the share of CPU.
  std::vector<std::string> finish(std::span<const MapPoint> map, double run_seconds,
                                  const Report& report = {});

  const RunStatistics& statistics() const { return statistics_; }
  const std::filesystem::path& folder() const { return folder_; }

 private:
  void write_map(std::span<const MapPoint> map, std::vector<std::string>& problems) const;
  std::string summary(std::size_t map_points, double run_seconds, const Report& report) const;

  std::filesystem::path folder_;
  RunDescription description_;
  std::optional<LineFile> trajectory_;  ///< of slam
  std::optional<LineFile> frames_;
  RunStatistics statistics_;
};

}  // namespace cosight::outbox
