#pragma once

#include <deque>
#include <mutex>
#include <optional>

#include "robot_agent/vins/imu_motion.hpp"

namespace cosight::vins {

/// Says how the camera moved between two frames before the second one's image is looked at: the newest state
/// that VINS found up to the first frame, led on by the IMU. May be asked and told in different threads; the
/// answer depends on what was found up to the first frame, not on how far VINS is beyond it. The errors of
/// VINS's states last; the answers' covariances are so large that whoever takes them all for independent ends
/// up about as sure as he may be.
class MotionGuide {
 public:
  MotionGuide(const ImuNoise& noise, const Pose& T_BS, double gravity)
      : noise_(noise), T_BS_(T_BS), gravity_(gravity) {}

  void add_imu(const ImuSample& sample);
  /// Of each frame, in their order; `state` is nothing when VINS does not track.
  void add(Stamp stamp, const std::optional<UncertainNavState>& state);

  /// Nothing when VINS did not track at the last frame up to `from`, that is too long ago, or the IMU's
  /// samples do not reach from there to `to`.
  std::optional<UncertainTwist> twist(Stamp from, Stamp to) const;

 private:
  struct Frame {
    Stamp stamp = 0;
    std::optional<UncertainNavState> state;
  };

  const Frame* newest_up_to(Stamp stamp) const;
  std::vector<ImuSample> samples(Stamp from, Stamp to) const;

  ImuNoise noise_;
  Pose T_BS_;
  double gravity_;
  mutable std::mutex mutex_;
  std::deque<Frame> frames_;
  ImuBuffer imu_;
  ImuSample last_imu_;
};

}  // namespace cosight::vins
