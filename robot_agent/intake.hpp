#pragma once

#include <atomic>
#include <optional>

#include "robot_agent/estimators.hpp"
#include "robot_agent/inbox/inbox.hpp"
#include "robot_agent/outbox/yaml_text.hpp"
#include "robot_agent/vins_back_end.hpp"
#include "robot_agent/wearer_locator.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/publisher.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::robot {

/// How the wearer is found by the lasers.
struct LocatorPlan {
  wearer::WearerOptions options;
  wearer::UncertainAngle yaw_WA;  ///< from the AHRS's north to the map's x axis
  bool yields = true;             ///< to a tracker, as soon as one speaks
};

/// Where every sample goes in, whoever brings it, from any thread: frames and orientations to the inbox,
/// scans and odometry to the locator, and poses to the inbox, of the locator or of a tracker.
class Intake {
 public:
  /// Without a `plan` only a tracker's poses are used. `inbox` has to outlive this. Throws TransportError.
  Intake(inbox::Inbox& inbox, const transport::Participant& participant,
         const std::optional<LocatorPlan>& plan);
  /// The same, but what the lasers say is not published.
  Intake(inbox::Inbox& inbox, const std::optional<LocatorPlan>& plan);

  /// Frames and IMU samples go to `vins` as well, or to it alone. Before the first sample; it has to outlive
  /// this.
  void feed(VinsBackEnd& vins, Estimators estimators);

  /// Of the robot's own sensors, or of its tracker.
  void push(Sample sample);
  /// False: the lasers alone say where the wearer is.
  bool takes_tracked_poses() const { return takes_tracked_; }
  void push_ahrs(AhrsSample sample, const inbox::PeerId& peer);

  /// After each frame.
  void robot_is_at(const FrameEstimate& estimate);

  /// The robot's own sensors have ended.
  void close();

  void report(outbox::YamlText& text) const;

 private:
  void feed_vins(const Sample& sample);
  void take_tracked(const WearerPoseSample& pose);
  void take_located(Stamp stamp, const std::optional<WearerPoseSample>& pose);

  inbox::Inbox& inbox_;
  bool takes_tracked_;
  VinsBackEnd* vins_ = nullptr;
  bool feeds_slam_ = true;
  std::atomic<bool> tracker_speaks_ = false;
  std::optional<transport::Publisher<WearerPoseSample>> located_;
  std::optional<WearerLocator> locator_;
};

}  // namespace cosight::robot
