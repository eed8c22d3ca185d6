#include "shared/dataset/paced_replay.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <thread>
#include <utility>

namespace cosight {

Stamp SteadyClock::now() const {
  return std::chrono::nanoseconds(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void SteadyClock::sleep_until(Stamp due, const std::atomic<bool>& stop) {
  constexpr Stamp kSlice = 20'000'000;
  for (Stamp left = due - now(); left > 0 && !stop; left = due - now()) {
    std::this_thread::sleep_for(std::chrono::nanoseconds(std::min(left, kSlice)));
  }
}

PacedReplay::PacedReplay(SourceFactory open, const ReplayOptions& options, PacingClock& clock,
                         const std::atomic<bool>& stop)
    : open_(std::move(open)), options_(options), clock_(clock), stop_(stop), lap_(open_()) {}

std::optional<Sample> PacedReplay::next() {
  if (stop_) return std::nullopt;
  auto sample = next_of_laps();
  if (!sample) return std::nullopt;
  const Stamp stamp = stamp_of(*sample);
  if (!clock_start_) {
    clock_start_ = clock_.now();
    data_start_ = stamp;
  }
  if (options_.rate > 0.0) {
    const double elapsed = to_seconds(stamp - data_start_) / options_.rate;
    clock_.sleep_until(*clock_start_ + from_seconds(elapsed), stop_);
  }
  if (stop_) return std::nullopt;
  return sample;
}

/// The next sample of this lap or of the one after it, on the stamps that go on.
std::optional<Sample> PacedReplay::next_of_laps() {
  auto sample = lap_->next();
  if (!sample) {
    if (!options_.loop || !first_ || !start_next_lap()) return std::nullopt;
    sample = lap_->next();
    if (!sample) return std::nullopt;
  }
  last_ = stamp_of(*sample);
  if (!first_) first_ = last_;
  if (auto* const image = std::get_if<ImageSample>(&*sample)) {
    if (last_image_) image_interval_ = image->stamp - *last_image_;
    last_image_ = image->stamp;
    image->sequence += sequence_shift_;
    next_sequence_ = image->sequence + 1;
  }
  std::visit([this](auto& s) { s.stamp += shift_; }, *sample);
  return sample;
}

bool PacedReplay::start_next_lap() {
  std::unique_ptr<SampleSource> next_lap;
  try {
    next_lap = open_();
  } catch (const std::exception&) {  // the input was there a lap ago: it has been taken away
    options_.loop = false;
    return false;
  }
  for (std::size_t kind = 0; kind < kSampleKinds; ++kind) {
    finished_laps_[kind] += lap_->counters(static_cast<SampleKind>(kind));
  }
  lap_ = std::move(next_lap);
  constexpr Stamp kUsualInterval = 10'000'000;  // of a source without images
  shift_ += last_ - *first_ + image_interval_.value_or(kUsualInterval);
  sequence_shift_ = next_sequence_;
  first_.reset();
  last_image_.reset();
  return true;
}

SourceCounters PacedReplay::counters(SampleKind kind) const {
  SourceCounters total = finished_laps_[static_cast<std::size_t>(kind)];
  return total += lap_->counters(kind);
}

std::string PacedReplay::description() const {
  return lap_->description();
}

}  // namespace cosight
