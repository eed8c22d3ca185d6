#pragma once

#include <atomic>
#include <functional>
#include <optional>
#include <string>
#include <vector>

#include "robot_agent/inbox/inbox.hpp"
#include "robot_agent/intake.hpp"
#include "robot_agent/options.hpp"
#include "robot_agent/outbox/publisher.hpp"
#include "robot_agent/outbox/run_record.hpp"
#include "robot_agent/outbox/status_text.hpp"
#include "robot_agent/own_sensors.hpp"
#include "robot_agent/slam/collaborative_slam.hpp"
#include "robot_agent/wearer_link.hpp"
#include "shared/transport/agent_presence.hpp"

namespace cosight::robot {

/// The robot's side: sensors -> inbox -> slam -> outbox, one estimating thread; vins beside it, or alone.
class RobotAgent {
 public:
  using Progress = std::function<void(const std::string& line)>;

  /// Opens everything. Throws ConfigError, DatasetError, TransportError or OutputError. `stop` ends `run` and
  /// has to outlive this.
  RobotAgent(const RobotOptions& options, const outbox::RunDescription& description,
             const std::atomic<bool>& stop);

  /// Until the input ends or `stop` is set. Returns what was lost, one sentence each; nothing when all went
  /// well.
  std::vector<std::string> run(const Progress& progress = {});

  const std::filesystem::path& run_folder() const { return record_.folder(); }
  const outbox::RunStatistics& statistics() const { return record_.statistics(); }

 private:
  void wait_for_wearer();
  void process(FrameBundle& bundle, const Progress& progress);
  std::vector<std::string> finish();

  RobotOptions options_;
  const std::atomic<bool>& stop_;
  transport::Participant participant_;
  AgentInput input_;
  inbox::Inbox inbox_;
  Intake intake_;
  std::optional<slam::CollaborativeSlam> slam_;
  std::optional<vins::VinsThreadOptions> vins_plan_;
  outbox::RunRecord record_;
  std::optional<VinsBackEnd> vins_;
  outbox::StatusText status_;
  outbox::EstimatePublisher publisher_;
  transport::AgentPresence presence_;
  std::optional<WearerLink> wearer_;  ///< none without slam
  OwnSensors sensors_;
  SteadyClock clock_;
  Stamp started_ = 0;
};

}  // namespace cosight::robot
