#include "robot_agent/inbox/interpolation.hpp"

#include <cmath>
#include <cstdlib>

namespace cosight::inbox {
namespace {

/// Two samples and where between them a stamp lies. One sample stands on both sides when the other is too
/// far.
template <typename T>
struct Bracket {
  const T* a = nullptr;
  const T* b = nullptr;
  double weight_b = 0.0;
  double seconds_from_a = 0.0;
  double seconds_to_b = 0.0;
};

template <typename T>
std::optional<Bracket<T>> bracket(const StampedHistory<T>& history, Stamp stamp, Stamp max_interval) {
  const auto [before, after] = history.neighbours(stamp);
  const bool before_near = before != nullptr && stamp - before->stamp <= max_interval;
  const bool after_near = after != nullptr && after->stamp - stamp <= max_interval;
  if (!before_near && !after_near) return std::nullopt;
  Bracket<T> result;
  result.a = before_near ? before : after;
  result.b = after_near ? after : before;
  result.seconds_from_a = to_seconds(std::abs(stamp - result.a->stamp));
  result.seconds_to_b = to_seconds(std::abs(result.b->stamp - stamp));
  if (result.a != result.b) {
    result.weight_b = result.seconds_from_a / (result.seconds_from_a + result.seconds_to_b);
  }
  return result;
}

/// Variance of what the samples don't tell: between two of them the way bends by up to (1/2) a dt_a dt_b;
/// beyond the last one it goes on by v dt.
template <typename T>
double motion_variance(const Bracket<T>& bracket, double acceleration, double speed) {
  const double sigma = bracket.a == bracket.b
                           ? speed * bracket.seconds_from_a
                           : 0.5 * acceleration * bracket.seconds_from_a * bracket.seconds_to_b;
  return sigma * sigma;
}

bool is_covariance(const Eigen::Matrix3d& covariance) {
  UncertainPose pose;
  pose.covariance.topLeftCorner<3, 3>() = covariance;
  return is_valid(pose);
}

}  // namespace

std::optional<WearerPoseSample> interpolate_pose(const StampedHistory<WearerPoseSample>& poses, Stamp stamp,
                                                 const InterpolationOptions& options) {
  const auto between = bracket(poses, stamp, options.max_interval);
  if (!between) return std::nullopt;
  const WearerPoseSample& a = *between->a;
  const WearerPoseSample& b = *between->b;
  const double weight_b = between->weight_b;
  WearerPoseSample result;
  result.stamp = stamp;
  result.has_orientation = a.has_orientation && b.has_orientation;
  result.T_SF.T.p = (1.0 - weight_b) * a.T_SF.T.p + weight_b * b.T_SF.T.p;
  result.T_SF.covariance.topLeftCorner<3, 3>() = (1.0 - weight_b) * a.T_SF.covariance.topLeftCorner<3, 3>() +
                                                 weight_b * b.T_SF.covariance.topLeftCorner<3, 3>();
  if (result.has_orientation) {
    result.T_SF.T.q = a.T_SF.T.q.slerp(weight_b, b.T_SF.T.q).normalized();
    result.T_SF.covariance = (1.0 - weight_b) * a.T_SF.covariance + weight_b * b.T_SF.covariance;
    result.T_SF.covariance.diagonal().tail<3>().array() +=
        motion_variance(*between, options.angular_acceleration, options.turn_rate);
  }
  result.T_SF.covariance.diagonal().head<3>().array() +=
      motion_variance(*between, options.acceleration, options.speed);
  return result;
}

std::optional<UncertainOrientation> interpolate_orientation(const StampedHistory<AhrsSample>& samples,
                                                            Stamp stamp,
                                                            const InterpolationOptions& options) {
  const auto between = bracket(samples, stamp, options.max_interval);
  if (!between) return std::nullopt;
  const double weight_b = between->weight_b;
  UncertainOrientation q_WH;
  q_WH.q = between->a->q_WH.slerp(weight_b, between->b->q_WH).normalized();
  q_WH.covariance =
      (1.0 - weight_b) * between->a->orientation_covariance + weight_b * between->b->orientation_covariance;
  q_WH.covariance.diagonal().array() +=
      motion_variance(*between, options.angular_acceleration, options.turn_rate);
  return q_WH;
}

UncertainOrientation free_camera_orientation(const UncertainOrientation& q_WH,
                                             const MountingOptions& options) {
  const Eigen::Quaterniond yaw(Eigen::AngleAxisd(options.yaw_offset, Eigen::Vector3d::UnitZ()));
  const Eigen::Matrix3d R_yaw = yaw.toRotationMatrix();
  UncertainOrientation q_WF;
  q_WF.q = (yaw * q_WH.q * options.q_HF).normalized();
  q_WF.covariance = R_yaw * q_WH.covariance * R_yaw.transpose();
  // The mounting's error is alike about all axes, so it needs no turning into those of W.
  q_WF.covariance.diagonal().array() += options.mounting_sigma * options.mounting_sigma;
  return q_WF;
}

bool is_valid(const WearerPoseSample& sample) {
  if (sample.has_orientation) return cosight::is_valid(sample.T_SF);
  return sample.T_SF.T.p.allFinite() && is_covariance(sample.T_SF.covariance.topLeftCorner<3, 3>());
}

bool is_valid(const AhrsSample& sample) {
  return sample.q_WH.coeffs().allFinite() && std::abs(sample.q_WH.norm() - 1.0) < 1e-3 &&
         is_covariance(sample.orientation_covariance);
}

}  // namespace cosight::inbox
