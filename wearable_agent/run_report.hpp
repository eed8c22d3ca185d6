#pragma once

#include <filesystem>
#include <string>

#include "shared/dataset/sample_source.hpp"
#include "shared/transport/wearer_publisher.hpp"

namespace cosight::wearable {

/// What a run sent and skipped.
struct RunReport {
  transport::SentCounters sent;
  SourceCounters frames;        ///< of the input
  SourceCounters orientations;  ///< of the input
  double duration = 0.0;        ///< from the first sample to the end [s]
  double cpu_seconds = 0.0;     ///< in that time, all threads
  double peak_memory_mb = 0.0;

  /// Input that could not be read, or samples that the middleware did not take.
  bool lost_data() const { return frames.lost() + orientations.lost() + sent.not_taken > 0; }
};

/// One line for the terminal: "12.3 s  123 frames (10.0/s)  1.23 MB/s …".
std::string status_text(const RunReport& report, int frame_readers);

/// The figures as yaml; `bytes_per_s`, `cpu_percent` and so on.
std::string summary_yaml(const RunReport& report);

/// Throws std::runtime_error that names the file.
void write_summary(const std::filesystem::path& file, const RunReport& report);

}  // namespace cosight::wearable
