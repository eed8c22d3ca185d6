#pragma once

#include <vector>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/slam/options.hpp"
#include "shared/dataset/known_point.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::slam {

/// A furnished room that the simulator draws, with a robot that drives through it and a wearer who walks
/// beside it and looks the same way. Rendered once; every pose is exact.
class TwoCameraWorld {
 public:
  static constexpr int kFrames = 40;
  static constexpr Stamp kFirstStamp = 100 * kNanosecondsPerSecond;
  static constexpr Stamp kInterval = kNanosecondsPerSecond / 10;

  /// The same world for all tests of a process.
  static const TwoCameraWorld& instance();

  /// Both images and the exact T_SF, whose covariance says 2 mm and 0.03 degrees.
  const FrameBundle& bundle(int frame) const { return bundles_[static_cast<std::size_t>(frame)]; }
  FrameBundle without_wearer(int frame) const;
  FrameBundle without_image(int frame) const;

  const CameraModel& camera() const { return camera_; }
  Pose T_WS(int frame) const;
  Pose T_WF(int frame) const;
  /// Length of the robot's way from one frame to another [m].
  double path_length(int first, int last) const;

  /// Corners of the first image and where they are in W.
  const std::vector<KnownPoint>& known_points() const { return known_points_; }

  /// Starts at the true first pose, with a motion that suits the robot; every worn frame is used.
  SlamOptions options() const;

 private:
  TwoCameraWorld();

  CameraModel camera_;
  std::vector<FrameBundle> bundles_;
  std::vector<KnownPoint> known_points_;
};

}  // namespace cosight::slam
