#pragma once

#include <atomic>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "robot_agent/inbox/inbox.hpp"
#include "robot_agent/intake.hpp"
#include "robot_agent/options.hpp"
#include "robot_agent/outbox/run_record.hpp"
#include "robot_agent/outbox/status_text.hpp"
#include "robot_agent/slam/collaborative_slam.hpp"
#include "shared/dataset/paced_replay.hpp"
#include "shared/recording/recording_source.hpp"

namespace cosight::robot {

/// The robot's side fed by a recording instead of DDS, in one thread: what comes when is what the file says,
/// so that the same file gives the same bytes, at any pace. Times of computing are not in `frames.csv`.
class OfflineRun {
 public:
  using Progress = std::function<void(const std::string& line)>;

  /// Throws ConfigError, RecordingError or OutputError. `stop` ends `run` and has to outlive this.
  OfflineRun(const RobotOptions& options, const outbox::RunDescription& description,
             const std::atomic<bool>& stop);

  /// Returns what was lost, one sentence each; nothing when all went well.
  std::vector<std::string> run(const Progress& progress = {});

  const std::filesystem::path& run_folder() const { return record_.folder(); }

 private:
  void pace(Stamp log_time);
  void push(recording::RecordedEvent&& event);
  void process_ready(const Progress& progress);
  std::vector<std::string> finish();

  RobotOptions options_;
  const std::atomic<bool>& stop_;
  recording::McapReader reader_;
  recording::RecordingSource source_;
  AgentInput input_;
  Stamp arrival_ = 0;  ///< log time of the newest event: the inbox's clock
  inbox::Inbox inbox_;
  Intake intake_;
  std::optional<slam::CollaborativeSlam> slam_;  ///< none when VINS runs alone
  std::optional<vins::VinsThreadOptions> vins_plan_;
  outbox::RunRecord record_;
  std::optional<VinsBackEnd> vins_;
  outbox::StatusText status_;
  SteadyClock clock_;
  Stamp began_ = 0;
};

}  // namespace cosight::robot
