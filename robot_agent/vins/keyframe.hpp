#pragma once

#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

struct KeyframeOptions {
  double min_parallax = 10.0 / 460.0;  ///< mean motion of the features between two frames [rad]
  std::size_t min_tracked = 20;        ///< fewer features followed into the newest frame: a keyframe at once
};

/// Whether the second newest frame is worth keeping (V14's two criteria): its features moved far from the
/// frame before it, or the newest frame has too few tracks. The newest frame's observations must be in the
/// window.
bool second_newest_is_keyframe(const Window& window, const KeyframeOptions& options);

}  // namespace cosight::vins
