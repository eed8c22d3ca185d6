#pragma once

#include <Eigen/Core>

#include "shared/geometry/pose.hpp"

namespace cosight {

/// T_AB with the covariance of its error in the axes of A, as geometry_msgs/PoseWithCovariance says it:
///
///   p = p_hat + dp,   R = Exp(dtheta) R_hat,   covariance of [dp (m), dtheta (rad)].
struct UncertainPose {
  Pose T;
  Eigen::Matrix<double, 6, 6> covariance = Eigen::Matrix<double, 6, 6>::Zero();
};

/// Covariance of [p (m), q (w, x, y, z)], the seven pose inputs of the pseudo-stereo noise (C section 3.2).
/// Of rank six: the quaternion's length carries no error.
Eigen::Matrix<double, 7, 7> position_quaternion_covariance(const UncertainPose& pose);

/// Finite, of unit quaternion within 1e-3, covariance symmetric and positive semidefinite (to rounding).
bool is_valid(const UncertainPose& pose);

}  // namespace cosight
