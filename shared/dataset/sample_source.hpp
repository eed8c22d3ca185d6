#pragma once

#include <cstdint>
#include <functional>
#include <memory>
#include <optional>
#include <string>

#include "shared/dataset/sample.hpp"

namespace cosight {

/// What a source skipped, and why; reported at the end of a run.
struct SourceCounters {
  std::uint64_t delivered = 0;
  std::uint64_t unreadable = 0;       ///< file missing, truncated, or not an image
  std::uint64_t wrong_size = 0;       ///< not the size that the calibration says
  std::uint64_t not_finite = 0;       ///< NaN, infinity or no number at all in a csv row
  std::uint64_t stamp_went_back = 0;  ///< dropped: older than or as old as the one before
  std::uint64_t gaps = 0;             ///< an interval over three times the usual one

  /// Samples that were in the input and are not in the output.
  std::uint64_t lost() const { return unreadable + wrong_size + not_finite + stamp_went_back; }
  SourceCounters& operator+=(const SourceCounters& other);
};

/// In the order of Sample's alternatives.
enum class SampleKind { kImage, kAhrs, kWearerPose, kLaserScan, kImu, kWheelOdometry };
constexpr std::size_t kSampleKinds = std::variant_size_v<Sample>;
inline SampleKind kind_of(const Sample& sample) {
  return static_cast<SampleKind>(sample.index());
}

/// Anything that yields samples in the order of their stamps: a folder, a video, a camera, a recording, a
/// topic. Construction throws when the source can't be opened; `next` never does.
class SampleSource {
 public:
  SampleSource() = default;
  SampleSource(const SampleSource&) = delete;
  SampleSource& operator=(const SampleSource&) = delete;
  virtual ~SampleSource() = default;

  /// The next sample, or nothing at the end. A live source blocks until there is one.
  virtual std::optional<Sample> next() = 0;

  virtual SourceCounters counters(SampleKind kind) const = 0;
  SourceCounters counters() const;  ///< of all kinds together

  /// What it is, for the log: "images ../kitti00/left (100 frames)".
  virtual std::string description() const = 0;
};

using SourceFactory = std::function<std::unique_ptr<SampleSource>()>;

}  // namespace cosight
