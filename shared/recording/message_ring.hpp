#pragma once

#include <deque>
#include <map>
#include <utility>

#include "shared/recording/message_queue.hpp"

namespace cosight::recording {

/// The last seconds of a recording, in memory; and of topics that say something once for all who come later
/// (a calibration), the last message however old.
class MessageRing {
 public:
  explicit MessageRing(Stamp duration) : duration_(duration) {}

  void add(ReceivedMessage&& message, bool is_latched) {
    const Stamp oldest = message.log_time - duration_;
    messages_.push_back({std::move(message), is_latched});
    while (messages_.front().message.log_time < oldest) {
      Entry& entry = messages_.front();
      if (entry.is_latched) latched_[entry.message.topic] = std::move(entry.message);
      messages_.pop_front();
    }
  }

  /// Oldest first: `visit(const ReceivedMessage&)`.
  template <class Visit>
  void for_each(Visit visit) const {
    for (const auto& [topic, message] : latched_)
      visit(message);
    for (const Entry& entry : messages_)
      visit(entry.message);
  }

 private:
  struct Entry {
    ReceivedMessage message;
    bool is_latched = false;
  };

  Stamp duration_;
  std::deque<Entry> messages_;
  std::map<std::size_t, ReceivedMessage> latched_;  ///< by topic: the last that fell out
};

}  // namespace cosight::recording
