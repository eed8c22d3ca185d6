#include "robot_agent/outbox/status_text.hpp"

#include <array>
#include <cstdio>

#include "robot_agent/outbox/frame_log.hpp"

namespace cosight::outbox {
namespace {

const char* spoken(Tracking tracking) {
  switch (tracking) {
    case Tracking::kWaitingForScale:
      return "waiting for scale";
    case Tracking::kTracking:
      return "tracking";
    case Tracking::kLost:
      return "lost";
  }
  return "";
}

/// Nothing before a worn frame came.
std::string link_text(const LinkState& link) {
  if (!link.worn_behind) return "";
  std::array<char, 64> text{};
  std::snprintf(text.data(), text.size(), "  worn %+.0f ms  clock %+.1f ms",
                1e3 * to_seconds(*link.worn_behind), 1e3 * to_seconds(link.wearer_offset));
  return text.data();
}

}  // namespace

std::optional<std::string> StatusText::update(const FrameBundle& bundle, const FrameEstimate& estimate,
                                              const LinkState& link, Stamp now) {
  if (!first_stamp_) first_stamp_ = estimate.stamp;
  if (!last_line_) last_line_ = now;
  ++frames_;
  with_overlap_ += estimate.overlap.predicted ? 1 : 0;
  matches_ += estimate.pseudo_stereo.fused + estimate.pseudo_stereo.initialised;
  milliseconds_ += frame_ms(bundle, estimate);
  const Stamp elapsed = now - *last_line_;
  if (elapsed < interval_) return std::nullopt;

  std::array<char, 160> line{};
  std::snprintf(line.data(), line.size(),
                "%s  %.1f s  %.1f frames/s  %.1f ms  %d landmarks  overlap %d %%  matches %d  lost %llu",
                spoken(estimate.tracking), to_seconds(estimate.stamp - *first_stamp_),
                frames_ / to_seconds(elapsed), milliseconds_ / frames_, estimate.landmarks,
                100 * with_overlap_ / frames_, matches_ / frames_,
                static_cast<unsigned long long>(link.lost));
  const std::string text = line.data() + link_text(link);
  last_line_ = now;
  frames_ = with_overlap_ = matches_ = 0;
  milliseconds_ = 0.0;
  return text;
}

}  // namespace cosight::outbox
