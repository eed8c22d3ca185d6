#pragma once

#include <Eigen/Core>
#include <optional>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::ekf {

/// Inverse depth from the current centre of a point that two cameras see, by the law of sines (DI-D):
///
///   beta = angle(h_other, b),  gamma = angle(h_current, -b),  alpha = pi - beta - gamma,
///   rho = sin(alpha) / (|b| sin(beta)),    b from the other centre to the current one.
struct SineDepth {
  double rho = 0.0;                                      ///< [1/m]; not positive when the rays part
  double parallax = 0.0;                                 ///< alpha [rad]; not positive when the rays part
  Eigen::RowVector3d rho_h_current, rho_h_other, rho_b;  ///< gradients of rho
};

/// Rays of any length, all three in the same axes. Nothing when a ray lies along the baseline (within about
/// 1e-6 rad) or there is none: then no depth can be told.
std::optional<SineDepth> inverse_depth_by_sines(const Eigen::Vector3d& h_current,
                                                const Eigen::Vector3d& h_other, const Eigen::Vector3d& b);

/// A feature in the SLAM camera and its match in the free camera [px].
struct StereoMatch {
  Eigen::Vector2d pixel_S = Eigen::Vector2d::Zero();
  Eigen::Vector2d pixel_F = Eigen::Vector2d::Zero();
};

/// The two cameras of pseudo-stereo and what is known of them in one frame.
struct StereoRig {
  CameraModel camera_S;
  CameraModel camera_F;
  UncertainPose T_SF;
  double sigma_pixel_S = 1.0;  ///< [px]
  double sigma_pixel_F = 1.0;  ///< [px]
  /// A better guess of where Cf is, to linearise its pixels at; what is known of it stays `T_SF`.
  bool has_guess = false;
  Pose T_SF_guess = {};
};

/// A match as a point of S, with its dependence on the eleven uncertain inputs (C section 3.2): the pixels in
/// the order (u_S v_S u_F v_F) and the pose as (t_x t_y t_z q_w q_x q_y q_z) of T_SF.
struct StereoPoint {
  Eigen::Vector3d p_S = Eigen::Vector3d::Zero();    ///< on the ray of pixel_S, 1/rho from its centre [m]
  Eigen::Vector3d ray_S = Eigen::Vector3d::Zero();  ///< unit ray of pixel_S
  double rho = 0.0;                                 ///< [1/m], positive
  double parallax = 0.0;                            ///< [rad]
  Eigen::Matrix<double, 3, 2> ray_pixel_S;          ///< d ray_S / d pixel_S
  Eigen::Matrix<double, 1, 4> rho_pixels;
  Eigen::Matrix<double, 1, 7> rho_pose;
  Eigen::Matrix<double, 3, 4> p_S_pixels;
  Eigen::Matrix<double, 3, 7> p_S_pose;
};

/// Nothing when a pixel has no ray, the rays part (parallax <= 0), or no depth can be told.
std::optional<StereoPoint> triangulate(const StereoMatch& match, const CameraModel& camera_S,
                                       const CameraModel& camera_F, const Pose& T_SF);

/// What a mapped landmark's match in the free camera measures (C section 3.2):
/// z_e = p_S, R_e = J diag(4 pixels, 7 pose) J^T.
struct PointMeasurement {
  Eigen::Vector3d p_S = Eigen::Vector3d::Zero();    ///< z_e [m]
  Eigen::Matrix3d R = Eigen::Matrix3d::Identity();  ///< R_e [m^2]
  /// B with B B^T the part of R that comes from the pose of Cf. All points of one frame share that pose's
  /// error, so the covariance between points i and j is B_i B_j^T.
  Eigen::Matrix<double, 3, 6> shared_factor = Eigen::Matrix<double, 3, 6>::Zero();
  double parallax = 0.0;  ///< [rad]
};
std::optional<PointMeasurement> measure_point(const StereoMatch& match, const StereoRig& rig);

/// L (6x6, lower) with L L^T = covariance; also of a semidefinite one, as of a pose known without error.
Eigen::Matrix<double, 6, 6> covariance_factor(const Eigen::Matrix<double, 6, 6>& covariance);

/// d [p, q (w, x, y, z)] / d [dp, dtheta] of an UncertainPose, 7x6.
Eigen::Matrix<double, 7, 6> position_quaternion_jacobian(const Pose& T);

}  // namespace cosight::ekf
