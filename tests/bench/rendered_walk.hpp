#pragma once

#include <vector>

#include "robot_agent/frame_bundle.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::bench {

/// A hall that the simulator draws: the robot drives through it at 0.6 m/s, the wearer walks beside it and
/// looks the same way. 20 Hz, 752x480, radtan lenses; T_SF comes from a tracker of 2 cm and 0.3 degrees.
/// Drawn once a process.
class RenderedWalk {
 public:
  static constexpr int kFrames = 160;

  static const RenderedWalk& instance();

  const std::vector<FrameBundle>& bundles() const { return bundles_; }
  const CameraModel& camera() const { return camera_; }
  /// True pose of the SLAM camera in W.
  static Pose T_WS(int frame);

 private:
  RenderedWalk();

  CameraModel camera_;
  std::vector<FrameBundle> bundles_;
};

}  // namespace cosight::bench
