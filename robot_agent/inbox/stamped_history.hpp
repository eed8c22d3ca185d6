#pragma once

#include <algorithm>
#include <cstddef>
#include <deque>
#include <optional>

#include "shared/dataset/stamp.hpp"

namespace cosight::inbox {

/// The newest samples of a stream in the order of their stamps, whatever order they arrive in. `T` has a
/// `stamp`. Bounded: the oldest goes.
template <typename T>
class StampedHistory {
 public:
  explicit StampedHistory(std::size_t capacity) : capacity_(capacity) {}

  /// A sample of the same stamp is replaced.
  void insert(const T& sample) {
    last_arrived_ = sample.stamp;
    const auto place = first_not_before(sample.stamp);
    if (place != samples_.end() && place->stamp == sample.stamp) {
      samples_[static_cast<std::size_t>(place - samples_.begin())] = sample;
      return;
    }
    samples_.insert(place, sample);
    if (samples_.size() > capacity_) samples_.pop_front();
  }

  /// The last sample at or before, and the first at or after a stamp; null where there is none, or where the
  /// stream passed before it came to one: whether that one had arrived yet must not matter.
  struct Neighbours {
    const T* before = nullptr;
    const T* after = nullptr;
  };
  Neighbours neighbours(Stamp stamp) const {
    Neighbours result;
    const auto after = first_not_before(stamp);
    if (after != samples_.end()) result.after = &*after;
    if (result.after != nullptr && result.after->stamp == stamp) {
      result.before = result.after;
    } else if (after != samples_.begin()) {
      result.before = &*std::prev(after);
    }
    if (result.after != nullptr && has_passed_between(stamp, result.after->stamp)) result.after = nullptr;
    return result;
  }

  /// The stream has come as far as `stamp`: what belongs there has arrived, or was lost. Judged by the sample
  /// that arrived last, so that one absurd stamp does not stand for the stream.
  bool reaches(Stamp stamp) const { return last_arrived_ && *last_arrived_ >= stamp; }

  /// The stream has come so far without a sample.
  void pass(Stamp stamp) {
    last_arrived_ = std::max(stamp, last_arrived_.value_or(stamp));
    passed_.push_back(stamp);
    if (passed_.size() > capacity_) passed_.pop_front();
  }

  std::size_t size() const { return samples_.size(); }
  void clear() {
    samples_.clear();
    passed_.clear();
    last_arrived_.reset();
  }

 private:
  typename std::deque<T>::const_iterator first_not_before(Stamp stamp) const {
    return std::lower_bound(samples_.begin(), samples_.end(), stamp,
                            [](const T& sample, Stamp s) { return sample.stamp < s; });
  }

  bool has_passed_between(Stamp from, Stamp to) const {
    return std::any_of(passed_.begin(), passed_.end(), [&](Stamp p) { return from <= p && p < to; });
  }

  std::size_t capacity_;
  std::deque<T> samples_;
  std::deque<Stamp> passed_;  ///< without a sample
  std::optional<Stamp> last_arrived_;
};

}  // namespace cosight::inbox
