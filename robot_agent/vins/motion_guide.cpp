#include "robot_agent/vins/motion_guide.hpp"

#include <algorithm>

namespace cosight::vins {
namespace {

constexpr std::size_t kMaxFrames = 64;
constexpr Stamp kMemory = 5 * kNanosecondsPerSecond;         ///< of the IMU
constexpr Stamp kMaxAge = kNanosecondsPerSecond / 2;         ///< of a state: its velocity is old by then
constexpr Stamp kMaxHold = kNanosecondsPerSecond * 2 / 100;  ///< the last sample stands for so much more
constexpr double kErrorLasts = 1.0;                          ///< about a window's span [s]

}  // namespace

void MotionGuide::add_imu(const ImuSample& sample) {
  const std::lock_guard lock(mutex_);
  if (!imu_.push(sample)) return;
  last_imu_ = sample;
  imu_.drop_before(sample.stamp - kMemory);
}

void MotionGuide::add(Stamp stamp, const std::optional<UncertainNavState>& state) {
  const std::lock_guard lock(mutex_);
  frames_.push_back({stamp, state});
  if (frames_.size() > kMaxFrames) frames_.pop_front();
}

std::optional<UncertainTwist> MotionGuide::twist(Stamp from, Stamp to) const {
  const std::lock_guard lock(mutex_);
  const Frame* known = newest_up_to(from);
  if (known == nullptr || !known->state || from - known->stamp > kMaxAge || to <= from) return std::nullopt;
  if (!imu_.covers(known->stamp, std::min(to, last_imu_.stamp)) || last_imu_.stamp < from ||
      to - last_imu_.stamp > kMaxHold)
    return std::nullopt;
  UncertainNavState start = *known->state;
  // The state's error, a scale above all, lasts as long as its window; told anew in every frame, it would be
  // believed so many times.
  start.covariance *= std::max(1.0, kErrorLasts / to_seconds(to - from));
  if (from > start.stamp)
    start = led_by_imu(start, {samples(start.stamp, from), start.state.bias, noise_}, gravity_);
  return mean_twist(start, {samples(from, to), start.state.bias, noise_}, T_BS_, gravity_);
}

const MotionGuide::Frame* MotionGuide::newest_up_to(Stamp stamp) const {
  const auto after = std::ranges::upper_bound(frames_, stamp, {}, &Frame::stamp);
  return after == frames_.begin() ? nullptr : &*(after - 1);
}

/// Up to `to`; the last sample stands for what has not come yet.
std::vector<ImuSample> MotionGuide::samples(Stamp from, Stamp to) const {
  if (to <= last_imu_.stamp) return imu_.between(from, to);
  std::vector<ImuSample> result =
      from < last_imu_.stamp ? imu_.between(from, last_imu_.stamp) : std::vector<ImuSample>{last_imu_};
  result.front().stamp = from;
  result.push_back(last_imu_);
  result.back().stamp = to;
  return result;
}

}  // namespace cosight::vins
