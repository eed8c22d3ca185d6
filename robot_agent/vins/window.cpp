#include "robot_agent/vins/window.hpp"

#include <algorithm>
#include <cassert>

namespace cosight::vins {

std::size_t Window::slot(FrameId id) const {
  const auto frame = std::lower_bound(frames.begin(), frames.end(), id,
                                      [](const WindowFrame& f, FrameId wanted) { return f.id < wanted; });
  assert(frame != frames.end() && frame->id == id);
  return static_cast<std::size_t>(frame - frames.begin());
}

void Window::add_observations(const FeatureFrame& frame) {
  for (const TrackedFeature& feature : frame.features) {
    Landmark& landmark = landmarks[feature.id];
    ++landmark.times_tracked;
    // A front end knows no velocity of a corner it has just found; to the next frame it is the same as from
    // there.
    if (landmark.times_tracked == 2 && landmark.observations.size() == 1 &&
        landmark.observations.front().sighting.velocity.isZero(0.0)) {
      landmark.observations.front().sighting.velocity = feature.sighting.velocity;
    }
    landmark.observations.push_back({frames.back().id, feature.sighting, landmark.times_tracked});
  }
}

bool Window::is_used(const Landmark& landmark, std::size_t min_observations) const {
  return landmark.has_depth && landmark.observations.size() >= min_observations;
}

}  // namespace cosight::vins
