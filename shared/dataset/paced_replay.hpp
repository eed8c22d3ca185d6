#pragma once

#include <array>
#include <atomic>

#include "shared/dataset/sample_source.hpp"

namespace cosight {

/// What a replay waits on. Tests set it by hand.
class PacingClock {
 public:
  PacingClock() = default;
  PacingClock(const PacingClock&) = delete;
  PacingClock& operator=(const PacingClock&) = delete;
  virtual ~PacingClock() = default;

  virtual Stamp now() const = 0;

  /// Returns at `due` or as soon as `stop` is seen, whichever comes first.
  virtual void sleep_until(Stamp due, const std::atomic<bool>& stop) = 0;
};

/// The machine's own steady clock; sees `stop` within 20 ms.
class SteadyClock : public PacingClock {
 public:
  Stamp now() const override;
  void sleep_until(Stamp due, const std::atomic<bool>& stop) override;
};

struct ReplayOptions {
  double rate = 1.0;  ///< times real time; 0: as fast as it can be read
  bool loop = false;  ///< starts again at the end, with stamps and sequence numbers going on
};

/// Samples in the rhythm of their stamps: whoever calls `next` can't tell it from a live source. The first
/// sample is due at once. Falling behind is made up for without dropping anything.
class PacedReplay : public SampleSource {
 public:
  /// `open` is called once a lap; what it throws comes out here, and on a later lap ends the replay. `clock`
  /// and `stop` have to outlive this; `next` gives nothing once `stop` is set.
  PacedReplay(SourceFactory open, const ReplayOptions& options, PacingClock& clock,
              const std::atomic<bool>& stop);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override;

 private:
  std::optional<Sample> next_of_laps();
  bool start_next_lap();

  SourceFactory open_;
  ReplayOptions options_;
  PacingClock& clock_;
  const std::atomic<bool>& stop_;
  std::unique_ptr<SampleSource> lap_;
  std::array<SourceCounters, kSampleKinds> finished_laps_{};

  Stamp shift_ = 0;                   ///< of this lap's stamps
  std::uint64_t sequence_shift_ = 0;  ///< of this lap's images
  std::optional<Stamp> first_;        ///< of this lap, as in the data
  Stamp last_ = 0;                    ///< of this lap, as in the data
  std::optional<Stamp> last_image_;
  std::optional<Stamp> image_interval_;  ///< between the last two images of a lap
  std::uint64_t next_sequence_ = 0;
  std::optional<Stamp> clock_start_;  ///< when the first sample was due
  Stamp data_start_ = 0;
};

}  // namespace cosight
