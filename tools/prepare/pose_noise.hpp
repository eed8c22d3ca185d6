#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <random>

#include "shared/geometry/uncertain_pose.hpp"

namespace cosight {

/// How well a tracker knows the pose of Cf in Cs; standard deviations in the axes of Cs.
struct PoseNoise {
  Eigen::Vector3d position_sigma = Eigen::Vector3d::Constant(0.01);  ///< [m]
  Eigen::Vector3d rotation_sigma =
      Eigen::Vector3d::Constant(9e-4);  ///< about x (pitch), y (yaw), z (roll) [rad]
};

/// Draws noisy observations of poses; the same seed gives the same ones.
class PoseNoiseSource {
 public:
  PoseNoiseSource(const PoseNoise& noise, std::uint64_t seed) : noise_(noise), random_(seed) {}

  /// The observed pose, with the covariance it was drawn from: true p = p + dp, true R = Exp(dtheta) R.
  UncertainPose observe(const Pose& T_SF);

 private:
  Eigen::Vector3d draw(const Eigen::Vector3d& sigma);

  PoseNoise noise_;
  std::mt19937_64 random_;
};

}  // namespace cosight
