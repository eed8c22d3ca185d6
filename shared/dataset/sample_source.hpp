#pragma once

#include <optional>
#include <string>

#include "shared/dataset/sample.hpp"

namespace cosight {

/// What a source skipped, and why; reported at the end of a run.
struct SourceCounters {
  std::uint64_t delivered = 0;
  std::uint64_t unreadable = 0;       ///< file missing, truncated, or not an image
  std::uint64_t wrong_size = 0;       ///< not the size that the calibration says
  std::uint64_t not_finite = 0;       ///< NaN or infinity in a csv row
  std::uint64_t stamp_went_back = 0;  ///< dropped: older than or as old as the one before
  std::uint64_t gaps = 0;             ///< an interval over three times the usual one
};

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

  virtual const SourceCounters& counters() const = 0;

  /// What it is, for the log: "images ../kitti00/left (100 frames, 1241x376)".
  virtual std::string description() const = 0;
};

}  // namespace cosight
