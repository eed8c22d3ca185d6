#include "robot_agent/wearer_locator.hpp"

#include <algorithm>
#include <cmath>
#include <tuple>
#include <utility>

namespace cosight::robot {
namespace {

/// Odometry, orientations and other lasers that are later than this, by the stamps, are not waited for.
constexpr Stamp kPatience = kNanosecondsPerSecond / 10;
constexpr std::size_t kMostHeadings = 100;  ///< that wait for a scan

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
  ahrs_stamp_ = std::max(sample.stamp, ahrs_stamp_.value_or(sample.stamp));
  use_ready_scans();
}

void WearerLocator::add(LaserScanSample scan) {
  const std::lock_guard lock(mutex_);
  newest_scan_ = std::max(newest_scan_, scan.stamp);
  Stamp& laser_stamp = laser_stamps_[scan.laser];
  laser_stamp = std::max(laser_stamp, scan.stamp);
  const auto place = std::upper_bound(waiting_.begin(), waiting_.end(), scan,
                                      [](const LaserScanSample& a, const LaserScanSample& b) {
                                        return std::tie(a.stamp, a.laser) < std::tie(b.stamp, b.laser);
                                      });
  waiting_.insert(place, std::move(scan));
  use_ready_scans();
}

void WearerLocator::add(const FrameEstimate& estimate) {
  if (estimate.tracking != Tracking::kTracking) return;
  constexpr Eigen::Index kYaw = 5;  // of [dp, dtheta], in the axes of W
  const double yaw_sigma = std::sqrt(estimate.T_WS.covariance(kYaw, kYaw));
  const std::lock_guard lock(mutex_);
  if (used_scan_ && *used_scan_ >= estimate.stamp + kEstimateDelay) ++estimates_late_;
  headings_.push_back({estimate.stamp,
                       estimate.T_WS.T.q,
                       yaw_sigma,
                       {yaw_WA_.angle + estimate.yaw_offset, estimate.yaw_offset_sigma}});
  if (headings_.size() > kMostHeadings) headings_.pop_front();
}

void WearerLocator::finish() {
  const std::lock_guard lock(mutex_);
  while (!waiting_.empty())
    use_first_stamp();
}

wearer::WearerCounters WearerLocator::counters() const {
  const std::lock_guard lock(mutex_);
  return tracker_.counters();
}

std::uint64_t WearerLocator::estimates_late() const {
  const std::lock_guard lock(mutex_);
  return estimates_late_;
}

void WearerLocator::use_ready_scans() {
  while (!waiting_.empty() && is_ready(waiting_.front()))
    use_first_stamp();
}

/// What is silent longer than the patience is not waited for at all.
bool WearerLocator::is_ready(const LaserScanSample& scan) const {
  if (newest_scan_ - scan.stamp > kPatience) return true;
  const auto has_come_or_is_silent = [&scan](Stamp newest) {
    return newest >= scan.stamp || scan.stamp - newest > kPatience;
  };
  const bool motion_known = odometry_stamp_ && *odometry_stamp_ >= scan.stamp;
  return motion_known && (!ahrs_stamp_ || has_come_or_is_silent(*ahrs_stamp_)) &&
         std::all_of(laser_stamps_.begin(), laser_stamps_.end(),
                     [&](const auto& laser) { return has_come_or_is_silent(laser.second); });
}

/// Each later scan of a stamp knows what the ones before it said.
void WearerLocator::use_first_stamp() {
  const Stamp stamp = waiting_.front().stamp;
  for (; !headings_.empty() && headings_.front().stamp + kEstimateDelay <= stamp; headings_.pop_front())
    use(headings_.front());
  used_scan_ = stamp;
  std::optional<WearerPoseSample> pose;
  for (; !waiting_.empty() && waiting_.front().stamp == stamp; waiting_.pop_front())
    pose = tracker_.add_scan(waiting_.front());
  found_(stamp, pose);
}

void WearerLocator::use(const Heading& heading) {
  tracker_.set_robot_orientation(heading.stamp, heading.q_WS, heading.yaw_sigma);
  if (heading.yaw_WA.sigma > 0.0) tracker_.set_yaw_offset(heading.yaw_WA);
}

}  // namespace cosight::robot
