#include "robot_agent/slam/stereo_view.hpp"

#include <cmath>
#include <numbers>

namespace cosight::slam {

ekf::StereoRig StereoView::sensed_rig() const {
  ekf::StereoRig sensed = rig;
  sensed.T_SF = T_SF_sensed;
  sensed.has_guess = true;
  sensed.T_SF_guess = rig.T_SF.T;
  return sensed;
}

std::optional<UncertainPose> wearer_pose(const WearerView& wearer, const UncertainPose& T_WS,
                                         const wearer::UncertainAngle& yaw) {
  if (wearer.has_orientation) return wearer.T_SF;
  if (!wearer.q_WF) return std::nullopt;
  const Eigen::Matrix3d R_SW = T_WS.T.q.conjugate().toRotationMatrix();
  UncertainPose T_SF = wearer.T_SF;
  const Eigen::Quaterniond turn(Eigen::AngleAxisd(yaw.angle, Eigen::Vector3d::UnitZ()));
  const Eigen::Matrix3d R_turn = turn.toRotationMatrix();
  Eigen::Matrix3d covariance = R_turn * wearer.q_WF_covariance * R_turn.transpose();
  covariance(2, 2) += yaw.sigma * yaw.sigma;
  T_SF.T.q = (T_WS.T.q.conjugate() * turn * *wearer.q_WF).normalized();
  T_SF.covariance.bottomRows<3>().setZero();
  T_SF.covariance.rightCols<3>().setZero();
  T_SF.covariance.bottomRightCorner<3, 3>() =
      R_SW * (covariance + T_WS.covariance.bottomRightCorner<3, 3>()) * R_SW.transpose();
  return T_SF;
}

bool has_depth(const ekf::StereoPoint& point, const ekf::StereoRig& rig, const PseudoStereoOptions& options) {
  constexpr double kDegree = std::numbers::pi / 180.0;
  if (point.parallax < options.min_parallax_deg * kDegree) return false;
  const Eigen::Vector4d pixel_variances(
      rig.sigma_pixel_S * rig.sigma_pixel_S, rig.sigma_pixel_S * rig.sigma_pixel_S,
      rig.sigma_pixel_F * rig.sigma_pixel_F, rig.sigma_pixel_F * rig.sigma_pixel_F);
  const double variance =
      point.rho_pixels.cwiseAbs2().dot(pixel_variances) +
      point.rho_pose * position_quaternion_covariance(rig.T_SF) * point.rho_pose.transpose();
  return std::sqrt(variance) < options.max_relative_depth_sigma * point.rho;
}

}  // namespace cosight::slam
