#pragma once

#include <atomic>
#include <chrono>

#include "robot_agent/inbox/inbox.hpp"
#include "robot_agent/intake.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/subscriber.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::robot {

/// Everything that comes from the wearer, and from whoever tracks it, handed on as it arrives.
class WearerLink {
 public:
  /// `track_poses`: T_SF may come from a tracker on DDS, not from the robot's own input. `inbox` and `intake`
  /// have to outlive this.
  WearerLink(const transport::Participant& participant, inbox::Inbox& inbox, Intake& intake,
             bool track_poses);

  /// True as soon as the wearer's calibration is known, which it sends with its first frame.
  bool wait_for_wearer(std::chrono::milliseconds timeout, const std::atomic<bool>& stop) const;

  std::uint64_t frames_lost() const;
  void report(outbox::YamlText& text) const;

 private:
  std::atomic<bool> has_calibration_ = false;
  transport::Subscriber<ImageSample> compressed_;
  transport::Subscriber<ImageSample> raw_;
  transport::Subscriber<CameraInfoSample> calibration_;
  transport::Subscriber<AhrsSample> ahrs_;
  transport::Subscriber<HeartbeatSample> heartbeat_;
  std::optional<transport::Subscriber<WearerPoseSample>> poses_;
};

}  // namespace cosight::robot
