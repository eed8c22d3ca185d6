#include "shared/geometry/uncertain_pose.hpp"

#include <Eigen/Eigenvalues>
#include <cmath>

#include "shared/geometry/rotation.hpp"

namespace cosight {

Eigen::Matrix<double, 7, 7> position_quaternion_covariance(const UncertainPose& pose) {
  Eigen::Matrix<double, 7, 6> J = Eigen::Matrix<double, 7, 6>::Zero();
  J.topLeftCorner<3, 3>().setIdentity();
  J.bottomRightCorner<4, 3>() = left_perturbation_jacobian(pose.T.q);
  return J * pose.covariance * J.transpose();
}

bool is_valid(const UncertainPose& pose) {
  if (!pose.T.p.allFinite() || !pose.T.q.coeffs().allFinite() || !pose.covariance.allFinite()) return false;
  if (std::abs(pose.T.q.norm() - 1.0) > 1e-3) return false;
  const double scale = pose.covariance.cwiseAbs().maxCoeff();
  if ((pose.covariance - pose.covariance.transpose()).cwiseAbs().maxCoeff() > 1e-6 * scale) return false;
  const Eigen::SelfAdjointEigenSolver<Eigen::Matrix<double, 6, 6>> solver(pose.covariance,
                                                                          Eigen::EigenvaluesOnly);
  return solver.eigenvalues().minCoeff() >= -1e-9 * scale;
}

}  // namespace cosight
