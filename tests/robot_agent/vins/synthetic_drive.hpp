#pragma once

#include <vector>

#include "robot_agent/vins/imu.hpp"
#include "robot_agent/vins/nav_state.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// A body on a smooth three-dimensional path with known derivatives, an IMU and a camera that sees points
/// around it. Shares no model with the estimator: its IMU comes from the path's own derivatives, its gravity
/// is its own.
class SyntheticDrive {
 public:
  explicit SyntheticDrive(unsigned seed, int points = 150);

  /// True pose and velocity `t` seconds into the drive, with the IMU's true biases.
  NavState state(double t) const;

  /// IMU samples at 200 Hz over [from, to] with the noise below; each call draws anew.
  std::vector<ImuSample> imu(double from, double to);

  /// What the camera sees at `t`, `pixel_noise` of white noise; ids are those of the points.
  FeatureFrame camera(double t, double pixel_noise);

  /// True distance of a point from the camera [m].
  double distance(FeatureId id, double t) const;

  Stamp stamp(double t) const { return 1'000'000'000'000 + from_seconds(t); }
  Pose T_BS() const;

  ImuNoise noise;  ///< zero it for perfect samples
  ImuBias bias;
  double gravity = 9.81;
  bool noisy = true;

 private:
  double gaussian();

  std::vector<Eigen::Vector3d> points_W_;
  unsigned long long random_;
};

}  // namespace cosight::vins
