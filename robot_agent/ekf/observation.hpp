#pragma once

#include <Eigen/Core>
#include <optional>

#include "robot_agent/ekf/camera_state.hpp"
#include "robot_agent/ekf/inverse_depth_point.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::ekf {

/// Jacobians of an observation of `Rows` rows of a landmark with `Landmark` parameters. Velocities are not
/// seen by any measurement: the camera's part stops after position and orientation.
template <int Rows, int Landmark>
struct ObservationJacobians {
  Eigen::Matrix<double, Rows, CameraState::kPoseDim> H_camera;
  Eigen::Matrix<double, Rows, Landmark> H_landmark;
};

/// The landmark as a pixel of the SLAM camera (C6, C7):
///
///   h_c = R_WS^T ( rho ([x y z] - r_WS) + m(theta, phi) ),   then pinhole and lens.        [px]
///
/// Scaled by rho, so that points at infinity (rho = 0, and a little beyond) are as good as any. Nothing when
/// the point is behind the camera or outside the lens model.
struct BearingObservation {
  static constexpr int kDim = 2;
  using Jacobians = ObservationJacobians<kDim, InverseDepthPoint::kDim>;
  using PointJacobians = ObservationJacobians<kDim, 3>;

  CameraModel camera;

  std::optional<Eigen::Vector2d> predict(const CameraState& x, const InverseDepthPoint& y,
                                         Jacobians* jacobians = nullptr) const;
  /// The same of a landmark kept as a point of W: h_c = R_WS^T (p_W - r_WS).
  std::optional<Eigen::Vector2d> predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                         PointJacobians* jacobians = nullptr) const;
};

/// The landmark as a pixel of the free camera, whose pose in S is known but for an error [dp, dtheta] in the
/// axes of S (UncertainPose):
///
///   h_F = R_SF^T ( h_c - rho t_SF ),   then pinhole and lens.                                    [px]
///
/// Scaled by rho as the bearing is. Nearly linear in depth and in the error of T_SF, which the triangulated
/// point is not. Nothing when the point is behind that camera or outside its lens model.
struct WearerObservation {
  static constexpr int kDim = 2;
  struct Jacobians : ObservationJacobians<kDim, InverseDepthPoint::kDim> {
    Eigen::Matrix<double, kDim, 6> H_wearer;  ///< by [dp, dtheta] of T_SF
  };
  struct PointJacobians : ObservationJacobians<kDim, 3> {
    Eigen::Matrix<double, kDim, 6> H_wearer;
  };

  CameraModel camera_F;
  Pose T_SF;

  std::optional<Eigen::Vector2d> predict(const CameraState& x, const InverseDepthPoint& y,
                                         Jacobians* jacobians = nullptr) const;
  std::optional<Eigen::Vector2d> predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                         PointJacobians* jacobians = nullptr) const;

 private:
  struct Scaled;
  template <class AnyJacobians>
  std::optional<Eigen::Vector2d> project(const CameraState& x, const Scaled& point, AnyJacobians* jacobians,
                                         Eigen::Matrix<double, kDim, 3>& J_S) const;
};

/// The landmark as a point in the SLAM camera (C5):
///
///   h_e = R_WS^T ( [x y z] + m(theta, phi) / rho - r_WS )                                   [m, axes of S]
///
/// Nothing when the landmark is at infinity (rho <= min_inverse_depth) or behind the camera.
struct EuclideanObservation {
  static constexpr int kDim = 3;
  using Jacobians = ObservationJacobians<kDim, InverseDepthPoint::kDim>;
  using PointJacobians = ObservationJacobians<kDim, 3>;

  double min_inverse_depth = 1e-3;  ///< [1/m]

  std::optional<Eigen::Vector3d> predict(const CameraState& x, const InverseDepthPoint& y,
                                         Jacobians* jacobians = nullptr) const;
  std::optional<Eigen::Vector3d> predict(const CameraState& x, const Eigen::Vector3d& p_W,
                                         PointJacobians* jacobians = nullptr) const;
};

/// A point of the camera as [x/z, y/z, 1/|p|]: bearing and inverse distance. What triangulation measures is
/// nearly linear in these, and far from it in metres. `J` (may be null): d / d p_S. p_S.z() > 0.
Eigen::Vector3d bearing_and_inverse_distance(const Eigen::Vector3d& p_S, Eigen::Matrix3d* J = nullptr);

}  // namespace cosight::ekf
