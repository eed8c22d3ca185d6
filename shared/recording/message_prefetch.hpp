#pragma once

#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <mutex>
#include <optional>
#include <thread>

#include "shared/recording/mcap_reader.hpp"

namespace cosight::recording {

/// A message with memory of its own.
struct PrefetchedMessage {
  ChannelId channel_id = 0;
  Stamp log_time = 0;
  Stamp publish_time = 0;
  Bytes payload;
};

/// Goes through the messages of a cursor in a thread of its own, so that whoever takes them waits neither for
/// the disk nor for a chunk to be decompressed.
class MessagePrefetch {
 public:
  static constexpr std::size_t kAhead = std::size_t{8} << 20;  ///< [bytes], and as much on the taking side

  explicit MessagePrefetch(MessageCursor cursor, std::size_t max_bytes = kAhead);
  ~MessagePrefetch();
  MessagePrefetch(const MessagePrefetch&) = delete;
  MessagePrefetch& operator=(const MessagePrefetch&) = delete;

  /// In the cursor's order; waits for it when it has not been read yet. Nothing at the end.
  std::optional<PrefetchedMessage> next();

  /// Chunks that could not be read, once `next` has given nothing.
  std::uint64_t damaged() const;

 private:
  void read_to_the_end();
  bool push(PrefetchedMessage&& message);

  MessageCursor cursor_;
  std::size_t max_bytes_;
  mutable std::mutex mutex_;
  std::condition_variable changed_;
  std::deque<PrefetchedMessage> messages_;
  std::size_t bytes_ = 0;  ///< of `messages_`
  std::uint64_t damaged_ = 0;
  bool is_at_end_ = false;
  bool is_abandoned_ = false;
  std::deque<PrefetchedMessage> taken_;  ///< by the side that calls `next`, all at once
  std::thread thread_;                   ///< last: uses all of the above
};

}  // namespace cosight::recording
