#pragma once

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <string>

#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

/// What became of a topic's messages.
struct TopicCounters {
  std::uint64_t received = 0;
  std::uint64_t lost = 0;     ///< gaps in a writer's sequence numbers, from the first that came
  std::uint64_t refused = 0;  ///< came while the queue to the disk was full
};

/// Counts every message that should be in a recording and isn't. Any thread.
class LossLedger {
 public:
  using WriterId = std::array<std::uint8_t, 16>;

  void received(std::size_t topic, const WriterId& writer, std::uint64_t sequence);
  void refused(std::size_t topic);

  TopicCounters of(std::size_t topic) const;
  TopicCounters total() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::size_t, TopicCounters> topics_;
  std::map<WriterId, std::uint64_t> last_sequence_;
};

}  // namespace cosight::recording
