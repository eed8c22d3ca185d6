#pragma once

#include <atomic>
#include <memory>
#include <optional>
#include <thread>

#include "robot_agent/inbox/inbox.hpp"
#include "robot_agent/intake.hpp"
#include "robot_agent/options.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "shared/dataset/agent_input.hpp"
#include "shared/dataset/paced_replay.hpp"
#include "shared/transport/robot_publisher.hpp"

namespace cosight::robot {

/// The robot's own camera, lasers, IMU, wheels and tracker, read in a thread of their own in the rhythm of
/// their stamps: straight to the intake, and to DDS for whoever records or watches, unless they came from
/// there.
class OwnSensors {
 public:
  /// `intake`, `inbox` and `stop` have to outlive this. Throws DatasetError or TransportError.
  OwnSensors(const AgentInput& input, const RobotOptions& options, const transport::Participant& participant,
             Intake& intake, inbox::Inbox& inbox, const std::atomic<bool>& stop);
  ~OwnSensors();
  OwnSensors(const OwnSensors&) = delete;
  OwnSensors& operator=(const OwnSensors&) = delete;

  void start();

  std::string description() const { return source_->description(); }
  /// Valid once the inbox has finished.
  SourceCounters counters() const { return source_->counters(); }
  void report(outbox::YamlText& text) const;

 private:
  void play();

  CameraModel camera_;
  bool as_fast_as_possible_;
  Intake& intake_;
  inbox::Inbox& inbox_;
  const std::atomic<bool>& stop_;
  SteadyClock clock_;
  std::unique_ptr<SampleSource> source_;
  std::optional<transport::RobotPublisher> publisher_;  ///< none when the samples come from topics
  std::thread thread_;
};

}  // namespace cosight::robot
