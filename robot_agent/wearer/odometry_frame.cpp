#include "robot_agent/wearer/odometry_frame.hpp"

#include <algorithm>
#include <cmath>

namespace cosight::wearer {
namespace {

constexpr std::size_t kKept = 64;  // 3 s at 20 Hz, far more than a scan can be late

Pose level(double x, double y, double yaw) {
  return {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())), {x, y, 0.0}};
}

}  // namespace

void OdometryFrame::add(const WheelOdometrySample& sample) {
  const bool finite = std::isfinite(sample.x) && std::isfinite(sample.y) && std::isfinite(sample.yaw) &&
                      std::isfinite(sample.speed) && std::isfinite(sample.turn_rate);
  if (!finite || (!rows_.empty() && sample.stamp <= rows_.back().stamp)) {
    ++refused_;
    return;
  }
  const Pose T_RB = level(sample.x, sample.y, sample.yaw);
  if (rows_.empty()) {
    T_OR_ = T_RB.inverse();
  } else if (!continues(rows_.back(), sample, T_OR_ * T_RB)) {
    T_OR_ = T_OB(sample.stamp) * T_RB.inverse();
    ++jumps_;
  }
  rows_.push_back({sample.stamp, T_OR_ * T_RB, sample.speed, sample.turn_rate});
  if (rows_.size() > kKept) rows_.pop_front();
}

bool OdometryFrame::continues(const Row& last, const WheelOdometrySample& sample, const Pose& T_OB) const {
  constexpr double kMaxSpeed = 5.0;     // [m/s]
  constexpr double kMaxTurnRate = 6.0;  // [rad/s]
  const double dt = to_seconds(sample.stamp - last.stamp);
  return sample.stamp - last.stamp <= kMaxGap && (T_OB.p - last.T_OB.p).norm() <= kMaxSpeed * dt + 0.05 &&
         last.T_OB.q.angularDistance(T_OB.q) <= kMaxTurnRate * dt + 0.05;
}

Pose OdometryFrame::T_OB(Stamp stamp) const {
  if (rows_.empty()) return {};
  const auto after = std::lower_bound(rows_.begin(), rows_.end(), stamp,
                                      [](const Row& row, Stamp t) { return row.stamp < t; });
  if (after == rows_.begin()) return after->T_OB;
  const Row& a = *std::prev(after);
  if (after == rows_.end()) {
    const double dt = to_seconds(std::min(stamp - a.stamp, kMaxGap));
    const double turn = a.turn_rate * dt;
    return a.T_OB * level(a.speed * dt * std::cos(0.5 * turn), a.speed * dt * std::sin(0.5 * turn), turn);
  }
  const double share = to_seconds(stamp - a.stamp) / to_seconds(after->stamp - a.stamp);
  return {a.T_OB.q.slerp(share, after->T_OB.q), (1.0 - share) * a.T_OB.p + share * after->T_OB.p};
}

bool OdometryFrame::knows(Stamp stamp) const {
  return !rows_.empty() && stamp >= rows_.front().stamp - kMaxGap && stamp <= rows_.back().stamp + kMaxGap;
}

}  // namespace cosight::wearer
