#pragma once

#include <atomic>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <string>
#include <vector>

#include "shared/dataset/paced_replay.hpp"
#include "shared/recording/mcap_reader.hpp"
#include "shared/recording/topic_selection.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::recording {

struct ReplayerOptions {
  double rate = 1.0;   ///< times real time; 0: as fast as it can be read
  double start = 0.0;  ///< into the recording [s]
  double end = 0.0;    ///< 0: its end [s]
  bool loop = false;
  TopicSelection topics;
  std::map<std::string, std::string> remap;   ///< a topic's name to another, ROS 2's names
  std::vector<std::string> expected_readers;  ///< wait for one on each of these; empty: for any on any topic
  double patience = 3.0;                      ///< for them [s]; then it starts without
};

/// What a keyboard, or a test, wants of a running replay. Any thread.
struct ReplayControl {
  std::atomic<bool> paused = false;
  std::atomic<int> steps = 0;  ///< messages still to be sent while paused
};

struct ReplayerStatus {
  Stamp position = 0;  ///< since the recording's beginning
  std::uint64_t sent = 0;
  bool paused = false;
};

struct ReplaySummary {
  std::uint64_t sent = 0;
  std::uint64_t failed = 0;   ///< not taken by the middleware
  std::uint64_t damaged = 0;  ///< chunks of the file that could not be read
  Stamp late_median = 0, late_p99 = 0, late_worst = 0;
  std::vector<std::string> without_reader;  ///< expected, or everything when nobody came
  std::vector<std::string> not_sent;        ///< topics that could not be, one sentence each
};

/// Sends a recording again: payloads, source stamps and quality of service as they were, in the rhythm of
/// their reception.
class Replayer {
 public:
  using Progress = std::function<void(const ReplayerStatus&)>;

  /// Makes a writer for each topic. All arguments have to outlive this.
  Replayer(const transport::Participant& participant, const McapReader& reader, ReplayerOptions options,
           PacingClock& clock);
  ~Replayer();
  Replayer(const Replayer&) = delete;
  Replayer& operator=(const Replayer&) = delete;

  /// Until the end or `stop`.
  ReplaySummary run(const std::atomic<bool>& stop, ReplayControl& control, const Progress& progress = {});

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::recording
