#pragma once

#include "robot_agent/ekf/camera_state.hpp"

namespace cosight::ekf {

/// Unknown accelerations, constant over one step, independent from step to step.
struct MotionNoise {
  double sigma_acceleration = 1.0;          ///< [m/s^2] each axis of W
  double sigma_angular_acceleration = 1.0;  ///< [rad/s^2] each axis of S
};

/// One step of constant velocity (C1-C4). The Jacobian's blocks that are not here are identity or zero.
struct MotionStep {
  CameraState x;
  double dt = 0.0;                        ///< r' by v: dt I
  Eigen::Matrix4d q_q;                    ///< d q' / d q
  Eigen::Matrix<double, 4, 3> q_omega;    ///< d q' / d omega, also d q' / d Omega
  CameraState::Covariance process_noise;  ///< G Q G^T

  /// F, whole; for tests and for filters that keep both triangles.
  CameraState::Covariance F() const;
};

/// With impulses V = a dt, Omega = alpha dt:
///   r' = r + (v + V) dt,  q' = q (x) exp((omega + Omega) dt),  v' = v + V,  omega' = omega + Omega.
/// `dt` [s] >= 0.
MotionStep predict_motion(const CameraState& x, double dt, const MotionNoise& noise);

}  // namespace cosight::ekf
