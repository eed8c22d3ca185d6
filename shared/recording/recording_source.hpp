#pragma once

#include <cstdint>
#include <optional>
#include <variant>

#include "shared/dataset/agent_input.hpp"
#include "shared/recording/mcap_reader.hpp"
#include "shared/transport/samples.hpp"

namespace cosight::recording {

/// Something that an agent received while it was recorded.
struct RecordedEvent {
  Stamp log_time = 0;  ///< when it came
  Agent from = Agent::kRobot;
  std::variant<Sample, CameraInfoSample, HeartbeatSample> content;
};

/// What goes into a robot agent, out of a recording: its own sensors, the wearer's, and a tracker's poses, in
/// the order of the file, decoded and checked as the live topics are. What the agents made of it is left out.
class RecordingSource {
 public:
  /// `reader` has to outlive this.
  explicit RecordingSource(const McapReader& reader);

  std::optional<RecordedEvent> next();

  std::uint64_t delivered() const { return delivered_; }
  /// No samples of their topics, or in a part of the file that is damaged.
  std::uint64_t unusable() const { return invalid_ + cursor_.damaged(); }

 private:
  const McapReader& reader_;
  MessageCursor cursor_;
  std::uint64_t delivered_ = 0;
  std::uint64_t invalid_ = 0;
};

/// The robot's camera as the recording tells it.
std::optional<CameraModel> recorded_robot_camera(const McapReader& reader);

}  // namespace cosight::recording
