#include "robot_agent/vins/imu.hpp"

#include <algorithm>
#include <cassert>
#include <iterator>

namespace cosight::vins {
namespace {

bool older(const ImuSample& sample, Stamp stamp) {
  return sample.stamp < stamp;
}

}  // namespace

bool ImuBuffer::push(const ImuSample& sample) {
  if (!sample.acceleration_B.allFinite() || !sample.angular_velocity_B.allFinite()) return false;
  if (last_is_ahead_of(sample.stamp)) samples_.pop_back();
  if (!samples_.empty() && sample.stamp <= samples_.back().stamp) return false;
  samples_.push_back(sample);
  return true;
}

/// Otherwise one sample from the future would be the last for ever.
bool ImuBuffer::last_is_ahead_of(Stamp stamp) const {
  constexpr Stamp kFarAhead = kNanosecondsPerSecond;
  const std::size_t count = samples_.size();
  return count > 1 && samples_[count - 1].stamp - stamp > kFarAhead && samples_[count - 2].stamp < stamp;
}

bool ImuBuffer::covers(Stamp from, Stamp to) const {
  return !samples_.empty() && samples_.front().stamp <= from && samples_.back().stamp >= to;
}

double ImuBuffer::longest_gap(Stamp from, Stamp to) const {
  assert(covers(from, to));
  Stamp longest = 0;
  auto after = std::lower_bound(samples_.begin(), samples_.end(), from + 1, older);
  for (; after != samples_.end(); ++after) {
    const Stamp before = std::prev(after)->stamp;
    if (before >= to) break;
    longest = std::max(longest, after->stamp - before);
  }
  return to_seconds(longest);
}

std::vector<ImuSample> ImuBuffer::between(Stamp from, Stamp to) const {
  assert(covers(from, to) && from < to);
  std::vector<ImuSample> samples{at(from)};
  auto next = std::lower_bound(samples_.begin(), samples_.end(), from + 1, older);
  for (; next != samples_.end() && next->stamp < to; ++next)
    samples.push_back(*next);
  samples.push_back(at(to));
  return samples;
}

void ImuBuffer::drop_before(Stamp stamp) {
  while (samples_.size() > 1 && samples_[1].stamp <= stamp)
    samples_.pop_front();
}

ImuSample ImuBuffer::at(Stamp stamp) const {
  const auto after = std::lower_bound(samples_.begin(), samples_.end(), stamp, older);
  if (after->stamp == stamp) return *after;
  const auto before = after - 1;
  const double share = to_seconds(stamp - before->stamp) / to_seconds(after->stamp - before->stamp);
  return {stamp, (1.0 - share) * before->acceleration_B + share * after->acceleration_B,
          (1.0 - share) * before->angular_velocity_B + share * after->angular_velocity_B};
}

}  // namespace cosight::vins
