#include "robot_agent/wearer_locator.hpp"

#include <algorithm>
#include <cmath>
#include <utility>

namespace cosight::robot {
namespace {

/// Odometry that is later than this, by the stamps, is not waited for.
constexpr Stamp kPatience = kNanosecondsPerSecond / 10;

}  // namespace

WearerLocator::WearerLocator(const wearer::WearerOptions& options, const wearer::UncertainAngle& yaw_WA,
                             Found found)
    : tracker_(options), yaw_WA_(yaw_WA), found_(std::move(found)) {
  tracker_.set_yaw_offset(yaw_WA);
}

void WearerLocator::add(const WheelOdometrySample& sample) {
  const std::lock_guard lock(mutex_);
  tracker_.add_odometry(sample);
  odometry_stamp_ = std::max(sample.stamp, odometry_stamp_.value_or(sample.stamp));
  use_ready_scans();
}

void WearerLocator::add(const AhrsSample& sample) {
  const std::lock_guard lock(mutex_);
  tracker_.add_ahrs(sample);
}

void WearerLocator::add(LaserScanSample scan) {
  const std::lock_guard lock(mutex_);
  newest_scan_ = std::max(newest_scan_, scan.stamp);
  const auto place =
      std::upper_bound(waiting_.begin(), waiting_.end(), scan.stamp,
                       [](Stamp stamp, const LaserScanSample& other) { return stamp < other.stamp; });
  waiting_.insert(place, std::move(scan));
  use_ready_scans();
}

void WearerLocator::add(const FrameEstimate& estimate) {
  if (estimate.tracking != Tracking::kTracking) return;
  constexpr Eigen::Index kYaw = 5;  // of [dp, dtheta], in the axes of W
  const double yaw_sigma = std::sqrt(estimate.T_WS.covariance(kYaw, kYaw));
  const std::lock_guard lock(mutex_);
  tracker_.set_robot_orientation(estimate.stamp, estimate.T_WS.T.q, yaw_sigma);
  if (estimate.yaw_offset_sigma > 0.0) {
    tracker_.set_yaw_offset({yaw_WA_.angle + estimate.yaw_offset, estimate.yaw_offset_sigma});
  }
}

void WearerLocator::finish() {
  const std::lock_guard lock(mutex_);
  while (!waiting_.empty())
    use_first();
}

wearer::WearerCounters WearerLocator::counters() const {
  const std::lock_guard lock(mutex_);
  return tracker_.counters();
}

void WearerLocator::use_ready_scans() {
  while (!waiting_.empty() && is_ready(waiting_.front()))
    use_first();
}

bool WearerLocator::is_ready(const LaserScanSample& scan) const {
  return (odometry_stamp_ && *odometry_stamp_ >= scan.stamp) || newest_scan_ - scan.stamp > kPatience;
}

void WearerLocator::use_first() {
  const LaserScanSample scan = std::move(waiting_.front());
  waiting_.pop_front();
  found_(scan.stamp, tracker_.add_scan(scan));
}

}  // namespace cosight::robot
