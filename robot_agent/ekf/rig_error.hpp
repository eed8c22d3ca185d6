#pragma once

#include <Eigen/Core>

#include "robot_agent/ekf/camera_state.hpp"
#include "robot_agent/ekf/triangulation.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::ekf {

/// What is done with the error of T_SF, the free camera's pose as the sensors tell it.
struct RigErrorOptions {
  /// In the state: matches correct it, and landmarks start from the corrected pose. Off: it is noise that the
  /// measurements of a frame share.
  bool is_state = false;
  double correlation_time = 0.0;  ///< of a Gauss-Markov process [s]; 0: new in every frame
  double white_share = 0.0;       ///< of its variance, what is new in every frame in any case
};

/// The error of T_SF in the state: six numbers behind the camera's, standard normal as long as no match has
/// told more. With L L^T the covariance that the sensors claim, T_SF is theirs moved by
///
///   [dp, dtheta] = L eta,    p = p_sensed + dp,    R = Exp(dtheta) R_sensed.
struct RigError {
  static constexpr int kOffset = CameraState::kDim;
  static constexpr int kDim = 6;
  using Vector = Eigen::Matrix<double, kDim, 1>;
  using Matrix = Eigen::Matrix<double, kDim, kDim>;

  /// eta' = phi eta + noise of variance 1 - phi^2: phi after `dt` [s].
  static double decay(double dt, const RigErrorOptions& options);
};

/// The free camera in one frame, as the state corrects it.
struct CorrectedRig {
  Pose T_SF;
  /// d [dp, dtheta] (of T_SF as it stands here, axes of S) / d eta.
  RigError::Matrix by_eta = RigError::Matrix::Zero();
  /// Times a standard normal: the part of the error that is not in the state.
  RigError::Matrix noise_factor = RigError::Matrix::Zero();
};
/// `eta` is zero where the error is no state.
CorrectedRig correct_rig(const UncertainPose& T_SF_sensed, const RigErrorOptions& options,
                         const RigError::Vector& eta);

/// J with Exp(theta + d) = Exp(J d) Exp(theta) to first order.
Eigen::Matrix3d left_jacobian(const Eigen::Vector3d& theta);

}  // namespace cosight::ekf
