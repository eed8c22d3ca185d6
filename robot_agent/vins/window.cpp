#include "robot_agent/vins/window.hpp"

#include <algorithm>
#include <cassert>
#include <cstdlib>

namespace cosight::vins {

std::size_t Window::slot(FrameId id) const {
  const auto frame = std::lower_bound(frames.begin(), frames.end(), id,
                                      [](const WindowFrame& f, FrameId wanted) { return f.id < wanted; });
  assert(frame != frames.end() && frame->id == id);
  return static_cast<std::size_t>(frame - frames.begin());
}

BodyTwist Window::twist(std::size_t slot) const {
  // To either side, so wide that little is left of the gyroscope's noise: the increments between the frames
  // have the same noise, where it takes part in the offset the least of it is at zero, and 10 ms to either
  // side found 5.6 ms of 8.
  constexpr Stamp kAbout = 50 * kNanosecondsPerSecond / 1000;
  const WindowFrame& frame = frames[slot];
  Eigen::Vector3d sum = Eigen::Vector3d::Zero();
  int count = 0;
  const auto add = [&](const std::optional<Preintegration>& imu) {
    if (!imu) return;
    for (const ImuSample& sample : imu->samples()) {
      if (std::abs(sample.stamp - frame.stamp) > kAbout) continue;
      sum += sample.angular_velocity_B;
      ++count;
    }
  };
  add(frame.imu);
  if (slot + 1 < frames.size()) add(frames[slot + 1].imu);
  if (count == 0) return {.v_W = frame.state.v_W};
  return {frame.state.v_W, sum / count - frame.state.bias.gyroscope};
}

Pose Window::T_WS(std::size_t slot) const {
  if (time_offset == 0.0) return frames[slot].state.T_WB * T_BS;
  return led_on(frames[slot].state.T_WB, twist(slot), time_offset) * T_BS;
}

void Window::add_observations(const FeatureFrame& frame) {
  for (const TrackedFeature& feature : frame.features) {
    Landmark& landmark = landmarks[feature.id];
    ++landmark.times_tracked;
    landmark.observations.push_back({frames.back().id, feature.sighting, landmark.times_tracked});
  }
}

bool Window::is_used(const Landmark& landmark, std::size_t min_observations) const {
  return landmark.has_depth && landmark.observations.size() >= min_observations;
}

}  // namespace cosight::vins
