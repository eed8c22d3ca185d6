#include "robot_agent/wearer/worn_camera.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>

#include "shared/geometry/rotation.hpp"

namespace cosight::wearer {
namespace {

constexpr std::size_t kKept = 100;     // orientations: 1 s, for scans that come late
constexpr double kOdometryYaw = 0.01;  // drift of the odometry's yaw [rad/s]

double squared(double value) {
  return value * value;
}

}  // namespace

bool WornCamera::add_ahrs(const AhrsSample& sample) {
  const bool usable = sample.q_WH.coeffs().allFinite() && std::abs(sample.q_WH.norm() - 1.0) < 1e-3 &&
                      sample.orientation_covariance.allFinite();
  if (!usable || (!ahrs_.empty() && sample.stamp <= ahrs_.back().stamp)) return false;
  ahrs_.push_back(sample);
  if (ahrs_.size() > kKept) ahrs_.pop_front();
  return true;
}

void WornCamera::set_map_yaw(Stamp stamp, const UncertainAngle& yaw_OW) {
  yaw_OW_ = yaw_OW;
  yaw_OW_stamp_ = stamp;
}

std::optional<UncertainAngle> WornCamera::yaw_OW(Stamp stamp) const {
  const double age = std::abs(to_seconds(stamp - yaw_OW_stamp_));
  if (!yaw_OW_ || age > options_.max_heading_age) return std::nullopt;
  return UncertainAngle{yaw_OW_->angle, std::hypot(yaw_OW_->sigma, kOdometryYaw * age)};
}

const AhrsSample* WornCamera::ahrs_at(Stamp stamp) const {
  const auto distance = [&](const AhrsSample& sample) { return std::abs(sample.stamp - stamp); };
  const auto nearest = std::min_element(
      ahrs_.begin(), ahrs_.end(), [&](const auto& a, const auto& b) { return distance(a) < distance(b); });
  if (nearest == ahrs_.end() || to_seconds(distance(*nearest)) > options_.max_ahrs_age) return nullptr;
  return &*nearest;
}

WornCamera::Offset WornCamera::from_head(Stamp stamp) const {
  const Eigen::Vector3d& p_HF = options_.p_HF;
  const AhrsSample* ahrs = ahrs_at(stamp);
  const auto yaw_OW = this->yaw_OW(stamp);
  Offset offset;
  if (ahrs != nullptr && yaw_OW && yaw_WA_) {
    const Eigen::Matrix3d R_OA =
        Eigen::AngleAxisd(yaw_OW->angle + yaw_WA_->angle, Eigen::Vector3d::UnitZ()).toRotationMatrix();
    offset.p = R_OA * (ahrs->q_WH * p_HF);
    Eigen::Matrix3d turn = R_OA * ahrs->orientation_covariance * R_OA.transpose();
    turn(2, 2) += squared(yaw_OW->sigma) + squared(yaw_WA_->sigma);
    offset.covariance = skew(offset.p) * turn * skew(offset.p).transpose();
  } else {
    // The head looks anywhere: E[p] = 0 and E[p p^T] = r^2 / 2 in the plane; nodding moves it up and down.
    constexpr double kNod = 0.2;  // [rad]
    const double r = p_HF.head<2>().norm();
    offset.p.z() = p_HF.z();
    offset.covariance.diagonal() << 0.5 * r * r, 0.5 * r * r, squared(kNod * r);
  }
  return offset;
}

WearerPoseSample WornCamera::pose(Stamp stamp, const Eigen::Vector2d& p_O, const Eigen::Matrix2d& covariance,
                                  const Pose& T_OB) const {
  const Offset offset = from_head(stamp);
  const Pose T_SO = options_.T_BS.inverse() * T_OB.inverse();
  const Eigen::Vector3d p_OF = Eigen::Vector3d(p_O.x(), p_O.y(), options_.height) + offset.p;
  Eigen::Matrix3d covariance_O = offset.covariance;
  covariance_O.topLeftCorner<2, 2>() += covariance;
  covariance_O.diagonal() += Eigen::Vector3d(squared(options_.sway_sigma), squared(options_.sway_sigma),
                                             squared(options_.height_sigma));
  WearerPoseSample sample;
  sample.stamp = stamp;
  sample.has_orientation = false;
  sample.T_SF.T.p = T_SO * p_OF;
  // A tilt of the robot turns the whole way from S to F.
  const Eigen::Matrix3d lever = skew(sample.T_SF.T.p);
  const Eigen::Matrix3d R_SO = T_SO.q.toRotationMatrix();
  covariance_O =
      R_SO * covariance_O * R_SO.transpose() + squared(options_.tilt_sigma) * lever * lever.transpose();
  sample.T_SF.covariance.topLeftCorner<3, 3>() = 0.5 * (covariance_O + covariance_O.transpose());
  return sample;
}

}  // namespace cosight::wearer
