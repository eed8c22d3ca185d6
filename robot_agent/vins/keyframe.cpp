#include "robot_agent/vins/keyframe.hpp"

namespace cosight::vins {
namespace {

const Observation* seen_from(const Landmark& landmark, FrameId frame) {
  for (auto seen = landmark.observations.rbegin(); seen != landmark.observations.rend(); ++seen) {
    if (seen->frame == frame) return &*seen;
    if (seen->frame < frame) break;
  }
  return nullptr;
}

}  // namespace

bool second_newest_is_keyframe(const Window& window, const KeyframeOptions& options) {
  if (window.frames.size() < 3) return true;
  const FrameId newest = window.frames.back().id;
  const FrameId second = window.frames[window.frames.size() - 2].id;
  const FrameId third = window.frames[window.frames.size() - 3].id;
  std::size_t tracked = 0;
  std::size_t pairs = 0;
  double parallax = 0.0;
  for (const auto& [id, landmark] : window.landmarks) {
    if (seen_from(landmark, newest) != nullptr && landmark.times_tracked > 1) ++tracked;
    const Observation* before = seen_from(landmark, third);
    const Observation* after = seen_from(landmark, second);
    if (before == nullptr || after == nullptr) continue;
    ++pairs;
    parallax += (after->sighting.point - before->sighting.point).norm();
  }
  return tracked < options.min_tracked || pairs == 0 ||
         parallax >= options.min_parallax * static_cast<double>(pairs);
}

}  // namespace cosight::vins
