#pragma once

#include <Eigen/Core>

namespace cosight {

/// How a camera S moves, in its own axes.
struct UncertainTwist {
  Eigen::Vector3d v_S = Eigen::Vector3d::Zero();                                 ///< [m/s]
  Eigen::Vector3d omega_S = Eigen::Vector3d::Zero();                             ///< [rad/s]
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();  ///< of [v_S, omega_S]
};

}  // namespace cosight
