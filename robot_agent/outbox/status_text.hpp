#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"

namespace cosight::outbox {

/// How the wearer's samples come.
struct LinkState {
  std::uint64_t lost = 0;                           ///< frames lost on the way so far
  std::optional<Stamp> worn_behind = std::nullopt;  ///< worn frames after the robot's of the same stamp [ns]
  Stamp wearer_offset = 0;  ///< robot's clock minus wearer's, as far as it is estimated [ns]
};

/// What a terminal shows of a running robot, averaged since the line before:
///
///   tracking  12.4 s  29.9 frames/s  8.1 ms  41 landmarks  overlap 63 %  matches 12  lost 0
///     worn +14 ms  clock +0.0 ms
///
/// (in one line).
class StatusText {
 public:
  explicit StatusText(Stamp interval = kNanosecondsPerSecond / 4) : interval_(interval) {}

  /// A new line when one is due. `now`: any clock that never goes back.
  std::optional<std::string> update(const FrameBundle& bundle, const FrameEstimate& estimate,
                                    const LinkState& link, Stamp now);

 private:
  Stamp interval_;
  std::optional<Stamp> first_stamp_;
  std::optional<Stamp> last_line_;
  int frames_ = 0;
  int with_overlap_ = 0;
  int matches_ = 0;
  double milliseconds_ = 0.0;
};

}  // namespace cosight::outbox
