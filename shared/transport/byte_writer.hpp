#pragma once

#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <vector>

#include "shared/transport/codec.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

struct PublisherCounters {
  std::uint64_t sent = 0;
  std::uint64_t bytes = 0;    ///< of payload
  std::uint64_t refused = 0;  ///< samples that can't be said in the topic's message: NaN, wrong encoding ...
  std::uint64_t failed = 0;   ///< the middleware did not take them
  std::uint64_t stalled = 0;  ///< publishing took over 100 ms
  std::uint64_t matched = 0;
  std::uint64_t unmatched = 0;
  std::uint64_t incompatible_qos = 0;
  std::uint64_t liveliness_lost = 0;  ///< this process did not say often enough that it lives
  int readers = 0;                    ///< at present
};

/// Sends payloads on one topic; the part of a Publisher that does not depend on the sample. Any thread.
class ByteWriter {
 public:
  /// Throws TransportError when the writer can't be made.
  ByteWriter(const Participant& participant, const TopicProfile& topic);
  ~ByteWriter();
  ByteWriter(const ByteWriter&) = delete;
  ByteWriter& operator=(const ByteWriter&) = delete;

  /// `encode` fills the payload that it is given. False when it found a fault or the middleware failed:
  /// counted, and logged at the first, second, fourth ... time.
  bool write(const std::function<Fault(std::vector<std::uint8_t>&)>& encode);

  bool wait_for_readers(int readers, std::chrono::milliseconds timeout) const;
  bool wait_until_delivered(std::chrono::milliseconds timeout);
  PublisherCounters counters() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::transport
