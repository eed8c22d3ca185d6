#include "robot_agent/ekf/rig_error.hpp"

#include <cmath>

#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {

double RigError::decay(double dt, const RigErrorOptions& options) {
  return options.correlation_time > 0.0 ? std::exp(-dt / options.correlation_time) : 0.0;
}

CorrectedRig correct_rig(const UncertainPose& T_SF_sensed, const RigErrorOptions& options,
                         const RigError::Vector& eta) {
  const RigError::Matrix L = covariance_factor(T_SF_sensed.covariance);
  CorrectedRig rig;
  rig.T_SF = T_SF_sensed.T;
  if (!options.is_state) {
    rig.noise_factor = L;
    return rig;
  }
  const RigError::Matrix L_state = std::sqrt(1.0 - options.white_share) * L;
  const RigError::Vector error = L_state * eta;
  rig.T_SF.p += error.head<3>();
  rig.T_SF.q = quaternion_exp(error.tail<3>()) * T_SF_sensed.T.q;
  rig.by_eta = L_state;
  rig.by_eta.bottomRows<3>() = left_jacobian(error.tail<3>()) * L_state.bottomRows<3>();
  rig.noise_factor = std::sqrt(options.white_share) * L;
  return rig;
}

Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta) {
  constexpr double kSmall = 1e-4;  // [rad] below it the series' next terms are rounding
  const double angle = theta.norm();
  const Eigen::Matrix3d X = skew(theta);
  const double a = angle < kSmall ? 0.5 : (1.0 - std::cos(angle)) / (angle * angle);
  const double b = angle < kSmall ? 1.0 / 6.0 : (angle - std::sin(angle)) / (angle * angle * angle);
  return Eigen::Matrix3d::Identity() + a * X + b * X * X;
}

}  // namespace cosight::ekf
