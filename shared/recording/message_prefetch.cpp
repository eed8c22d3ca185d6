#include "shared/recording/message_prefetch.hpp"

#include <utility>

namespace cosight::recording {

MessagePrefetch::MessagePrefetch(MessageCursor cursor, std::size_t max_bytes)
    : cursor_(std::move(cursor)), max_bytes_(max_bytes), thread_([this] { read_to_the_end(); }) {}

MessagePrefetch::~MessagePrefetch() {
  {
    const std::lock_guard lock(mutex_);
    is_abandoned_ = true;
  }
  changed_.notify_all();
  thread_.join();
}

/// Both threads meet once for many messages, so that neither waits for the other to be scheduled.
std::optional<PrefetchedMessage> MessagePrefetch::next() {
  if (taken_.empty()) {
    std::unique_lock lock(mutex_);
    changed_.wait(lock, [this] { return !messages_.empty() || is_at_end_; });
    taken_.swap(messages_);
    bytes_ = 0;
    changed_.notify_all();
  }
  if (taken_.empty()) return std::nullopt;
  PrefetchedMessage message = std::move(taken_.front());
  taken_.pop_front();
  return message;
}

std::uint64_t MessagePrefetch::damaged() const {
  const std::lock_guard lock(mutex_);
  return damaged_;
}

void MessagePrefetch::read_to_the_end() {
  while (const auto message = cursor_.next()) {
    PrefetchedMessage own{message->channel_id,
                          message->log_time,
                          message->publish_time,
                          {message->payload.begin(), message->payload.end()}};
    if (!push(std::move(own))) break;
  }
  const std::lock_guard lock(mutex_);
  damaged_ = cursor_.damaged();
  is_at_end_ = true;
  changed_.notify_all();
}

/// False: nobody wants any more. A message larger than all of the room goes in alone.
bool MessagePrefetch::push(PrefetchedMessage&& message) {
  std::unique_lock lock(mutex_);
  changed_.wait(lock, [&] {
    return is_abandoned_ || messages_.empty() || bytes_ + message.payload.size() <= max_bytes_;
  });
  if (is_abandoned_) return false;
  bytes_ += message.payload.size();
  messages_.push_back(std::move(message));
  if (messages_.size() == 1) changed_.notify_all();
  return true;
}

}  // namespace cosight::recording
