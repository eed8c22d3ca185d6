#include "shared/recording/loss_ledger.hpp"

#include <algorithm>

namespace cosight::recording {

void LossLedger::received(std::size_t topic, const WriterId& writer, std::uint64_t sequence) {
  const std::lock_guard lock(mutex_);
  TopicCounters& counters = topics_[topic];
  ++counters.received;
  std::uint64_t& last = last_sequence_[writer];
  if (last != 0 && sequence > last + 1) counters.lost += sequence - last - 1;
  last = std::max(last, sequence);
}

void LossLedger::refused(std::size_t topic) {
  const std::lock_guard lock(mutex_);
  ++topics_[topic].refused;
}

TopicCounters LossLedger::of(std::size_t topic) const {
  const std::lock_guard lock(mutex_);
  const auto found = topics_.find(topic);
  return found == topics_.end() ? TopicCounters{} : found->second;
}

TopicCounters LossLedger::total() const {
  const std::lock_guard lock(mutex_);
  TopicCounters sum;
  for (const auto& [topic, counters] : topics_) {
    sum.received += counters.received;
    sum.lost += counters.lost;
    sum.refused += counters.refused;
  }
  return sum;
}

}  // namespace cosight::recording
