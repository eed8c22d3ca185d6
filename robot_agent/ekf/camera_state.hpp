#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>

#include "shared/geometry/pose.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {

/// The SLAM camera's part of the state (C1): x_v = [r_WS q_WS v_W omega_S].
struct CameraState {
  static constexpr int kPosition = 0;
  static constexpr int kOrientation = 3;
  static constexpr int kVelocity = 7;
  static constexpr int kAngularVelocity = 10;
  static constexpr int kDim = 13;
  static constexpr int kPoseDim = 7;  ///< position and orientation, the part a measurement sees

  using Vector = Eigen::Matrix<double, kDim, 1>;
  using Covariance = Eigen::Matrix<double, kDim, kDim>;

  Eigen::Vector3d r_WS = Eigen::Vector3d::Zero();            ///< camera centre in W [m]
  Eigen::Quaterniond q_WS = Eigen::Quaterniond::Identity();  ///< as (w, x, y, z) in the state
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();             ///< [m/s], axes of W
  Eigen::Vector3d omega_S = Eigen::Vector3d::Zero();         ///< [rad/s], axes of S

  static CameraState from_vector(const Vector& x) {
    return {x.segment<3>(kPosition), from_wxyz(x.segment<4>(kOrientation)), x.segment<3>(kVelocity),
            x.segment<3>(kAngularVelocity)};
  }
  Vector vector() const {
    Vector x;
    x << r_WS, wxyz(q_WS), v_W, omega_S;
    return x;
  }
  Pose T_WS() const { return {q_WS, r_WS}; }
};

}  // namespace cosight::ekf
