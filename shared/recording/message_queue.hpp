#pragma once

#include <chrono>
#include <condition_variable>
#include <cstddef>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "shared/recording/byte_sink.hpp"

namespace cosight::recording {

/// A message on its way from the middleware's thread to the disk's.
struct ReceivedMessage {
  std::size_t topic = 0;  ///< index into the recording's topics
  std::uint64_t sequence = 0;
  Stamp log_time = 0;
  Stamp publish_time = 0;
  Bytes payload;
};

/// Between whoever receives and whoever writes; what the disk can't keep up with is refused, not waited for.
class MessageQueue {
 public:
  explicit MessageQueue(std::size_t max_bytes) : max_bytes_(max_bytes) {}

  /// False when it is full.
  bool push(ReceivedMessage&& message) {
    const std::lock_guard lock(mutex_);
    if (bytes_ + message.payload.size() > max_bytes_) return false;
    bytes_ += message.payload.size();
    messages_.push_back(std::move(message));
    arrived_.notify_one();
    return true;
  }

  /// All that is there into `messages`, waiting at most `timeout` for the first.
  void take(std::vector<ReceivedMessage>& messages, std::chrono::milliseconds timeout) {
    messages.clear();
    std::unique_lock lock(mutex_);
    arrived_.wait_for(lock, timeout, [this] { return !messages_.empty(); });
    messages.swap(messages_);
    bytes_ = 0;
  }

 private:
  std::size_t max_bytes_;
  std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<ReceivedMessage> messages_;
  std::size_t bytes_ = 0;
};

}  // namespace cosight::recording
