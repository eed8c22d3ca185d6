#pragma once

#include <cstdint>
#include <filesystem>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "robot_agent/estimators.hpp"
#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/vins/motion_guide.hpp"
#include "robot_agent/vins_record.hpp"
#include "shared/dataset/sample.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/publisher.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::robot {

/// VINS as the robot agent runs it: beside slam, in a thread of its own, fed by the same camera and the
/// robot's IMU. What it estimates goes to `vins.tum` and, live, to rt/cosight/robot/vins/odometry.
class VinsBackEnd {
 public:
  /// `options`: as planned for the input, see vins_plan.hpp. `participant`: null without DDS. Throws
  /// OutputError or TransportError.
  VinsBackEnd(const vins::VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS,
              const std::filesystem::path& run_folder, const transport::Participant* participant,
              const VinsHelp& help);

  void push(const ImuSample& sample);
  /// Of no effect when VINS is to take slam's depths: then the images come with them.
  void push(const ImageSample& frame);
  /// What slam made of a bundle: its image with the depths that the wearer's view gave, when VINS takes them.
  void push(const FrameBundle& bundle, const FrameEstimate& estimate);

  /// Tells slam's next bundle how the camera moved since the one before, when VINS is to guide slam. It waits
  /// for what VINS makes of that one's image, live for some milliseconds at most, so that the answer is the
  /// same each time.
  void guide(FrameBundle& bundle);

  /// No more samples will come: waits for what is being processed.
  void finish();

  /// "vins tracking", "vins not yet observable: too little parallax": for a terminal.
  std::string status() const;

  /// After finish().
  void report(outbox::YamlText& text) const;
  /// After finish(): what was lost, one sentence each.
  std::vector<std::string> problems();

 private:
  void take(const vins::VinsEstimate& estimate, const vins::Window& window);

  CameraModel camera_;
  vins::VinsThreadOptions options_;
  VinsRecord record_;
  std::optional<transport::Publisher<OdometrySample>> publisher_;
  bool takes_depths_;
  std::optional<vins::MotionGuide> guide_;
  std::optional<Stamp> last_bundle_;  ///< that guide() saw
  std::uint64_t frames_guided_ = 0;
  mutable std::mutex mutex_;
  std::string state_ = "waiting for images";
  vins::VinsThread thread_;  ///< last: it uses all of the above
};

}  // namespace cosight::robot
