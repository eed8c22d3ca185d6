#pragma once

#include <atomic>
#include <functional>

#include "shared/dataset/agent_input.hpp"
#include "shared/transport/agent_presence.hpp"
#include "wearable_agent/options.hpp"
#include "wearable_agent/run_report.hpp"

namespace cosight::wearable {

/// The worn side: reads its input in the rhythm of its stamps and publishes frames, orientations, camera info
/// and a heartbeat.
class WearableAgent {
 public:
  /// Called about four times a second while samples are sent.
  using Progress = std::function<void(const RunReport& report, int frame_readers)>;

  /// Opens everything. Throws ConfigError, DatasetError or TransportError. `stop` ends `run` and has to
  /// outlive this.
  WearableAgent(const WearableOptions& options, const std::atomic<bool>& stop);

  /// Until the input ends or `stop` is set. Throws TransportError when no robot came in time, or when another
  /// wearable with this id was there first.
  RunReport run(const Progress& progress = {});

 private:
  void listen_for_twin() const;
  void wait_for_robot() const;
  void refuse_to_be_second() const;
  RunReport report() const;

  WearableOptions options_;
  const std::atomic<bool>& stop_;
  AgentInput input_;
  SteadyClock clock_;
  std::unique_ptr<SampleSource> source_;
  transport::Participant participant_;
  transport::AgentPresence presence_;
  transport::WearerPublisher publisher_;
  Stamp started_ = 0;          ///< by `clock_`
  double cpu_at_start_ = 0.0;  ///< [s]
};

}  // namespace cosight::wearable
