#pragma once

#include <atomic>
#include <cstdint>
#include <filesystem>
#include <functional>
#include <string>
#include <vector>

#include "shared/recording/loss_ledger.hpp"
#include "shared/recording/message_schemas.hpp"
#include "shared/recording/recording_files.hpp"
#include "shared/recording/topic_selection.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::recording {

struct RecorderOptions {
  std::filesystem::path path;  ///< "trial.mcap"
  TopicSelection topics;
  SplitOptions split;
  WriterOptions writer;
  double ring_seconds = 0.0;  ///< keep only so much, in memory, until it is asked for; 0: write it all
  double max_seconds = 0.0;   ///< then it ends by itself; 0: never
  std::size_t queue_bytes = std::size_t{256} << 20;  ///< what the disk may be behind
};

/// What it is doing, twice a second.
struct RecorderStatus {
  std::size_t topics = 0;
  TopicCounters counters;
  std::uint64_t bytes_written = 0;
  std::uint64_t saved = 0;  ///< rings
};

struct RecordedSummary {
  std::vector<std::filesystem::path> files;
  TopicCounters counters;
  std::uint64_t messages = 0;           ///< in the files
  std::vector<std::string> unrecorded;  ///< topics that could not be, one sentence each
};

/// Records every topic that somebody in the domain writes, knowing none of them. What has been received is on
/// its way to the disk after a quarter of a second, so that a killed recorder loses no more than half a
/// second.
class Recorder {
 public:
  using Progress = std::function<void(const RecorderStatus&)>;

  /// Throws RecordingError when the file can't be made.
  Recorder(const transport::Participant& participant, RecorderOptions options, MessageSchemas schemas,
           SessionNotes notes);
  ~Recorder();
  Recorder(const Recorder&) = delete;
  Recorder& operator=(const Recorder&) = delete;

  /// Until `stop` is set, then finishes the file. `save`: a number that grows each time the ring is to be
  /// saved. Throws RecordingError as soon as the disk takes no more; what was written stays readable.
  RecordedSummary run(const std::atomic<bool>& stop, const std::atomic<int>& save,
                      const Progress& progress = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::recording
