#include "tools/prepare/pose_noise.hpp"

#include <cmath>
#include <numbers>

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

/// Uniform in (0, 1) from the generator's 53 upper bits. Written out, with Box-Muller below, because the
/// standard library's distributions differ from one library to the next, and prepared data must not.
double uniform(std::mt19937_64& random) {
  return (static_cast<double>(random() >> 11U) + 0.5) * 0x1.0p-53;
}

double normal(std::mt19937_64& random) {
  const double radius = std::sqrt(-2.0 * std::log(uniform(random)));
  return radius * std::cos(2.0 * std::numbers::pi * uniform(random));
}

}  // namespace

Eigen::Vector3d PoseNoiseSource::draw(const Eigen::Vector3d& sigma) {
  Eigen::Vector3d noise;
  for (int axis = 0; axis < 3; ++axis)
    noise(axis) = sigma(axis) * normal(random_);
  return noise;
}

UncertainPose PoseNoiseSource::observe(const Pose& T_SF) {
  const Eigen::Vector3d dp = draw(noise_.position_sigma);
  const Eigen::Vector3d dtheta = draw(noise_.rotation_sigma);
  UncertainPose observed;
  observed.T = {(quaternion_exp(-dtheta) * T_SF.q).normalized(), T_SF.p - dp};
  observed.covariance.diagonal() << noise_.position_sigma.cwiseAbs2(), noise_.rotation_sigma.cwiseAbs2();
  return observed;
}

}  // namespace cosight
