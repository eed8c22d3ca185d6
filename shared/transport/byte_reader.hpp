#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>

#include "shared/transport/codec.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

using WriterId = std::array<std::uint8_t, 16>;  ///< GUID

/// How a sample came. Sequences count per writer from 1; a restarted writer is a new one.
struct Reception {
  Stamp stamp = 0;  ///< of this host's clock, on arrival
  WriterId writer_id{};
  std::uint64_t sequence = 0;
  bool from_own_process = false;  ///< its writer belongs to the same participant
};

struct SubscriberCounters {
  std::uint64_t received = 0;  ///< valid samples
  std::uint64_t bytes = 0;     ///< of payload, valid or not
  std::uint64_t lost = 0;      ///< gaps in a writer's sequences, from the first that came
  std::uint64_t invalid = 0;   ///< dropped: not a sample of this topic
  std::uint64_t callback_failed = 0;
  std::uint64_t matched = 0;
  std::uint64_t unmatched = 0;
  std::uint64_t liveliness_lost = 0;  ///< a writer fell silent for longer than its lease
  std::uint64_t incompatible_qos = 0;
  int writers = 0;  ///< at present
  Fault last_fault = Fault::kNone;
};

/// Receives payloads of one topic; the part of a Subscriber that does not depend on the sample.
class ByteReader {
 public:
  using Receive = std::function<Fault(std::span<const std::uint8_t>, const Reception&)>;

  using Gone = std::function<void(const WriterId&)>;

  /// `receive` runs on a thread of the middleware, one call at a time, until the destructor returns; `gone`
  /// likewise, beside it, when a writer has left or fallen silent, once or more. Throws TransportError when
  /// the reader can't be made.
  ByteReader(const Participant& participant, const TopicProfile& topic, Receive receive, Gone gone = {});
  ~ByteReader();
  ByteReader(const ByteReader&) = delete;
  ByteReader& operator=(const ByteReader&) = delete;

  bool wait_for_writers(int writers, std::chrono::milliseconds timeout) const;
  SubscriberCounters counters() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::transport
