#pragma once

#include <chrono>
#include <cstdint>
#include <vector>

#include "shared/transport/byte_writer.hpp"

namespace cosight::transport {

/// Publishes samples on one topic of `topics`. Any thread.
template <class Sample>
class Publisher {
 public:
  /// Throws TransportError when the middleware refuses the topic.
  Publisher(const Participant& participant, const Topic<Sample>& topic)
      : profile_(topic.profile), writer_(participant, topic.profile) {}

  /// Hands the sample to the middleware and returns: at most 100 ms, in practice microseconds. False when the
  /// sample can't be said on this topic (a JPEG on the raw topic, a NaN) or the middleware does not take it:
  /// see `counters`.
  bool publish(const Sample& sample) {
    return writer_.write(
        [&](std::vector<std::uint8_t>& payload) { return encode(sample, profile_, payload); });
  }

  /// True as soon as that many readers are matched.
  bool wait_for_readers(int readers, std::chrono::milliseconds timeout) const {
    return writer_.wait_for_readers(readers, timeout);
  }

  /// True as soon as every reliable reader has acknowledged everything; before leaving, so that the last
  /// arrives.
  bool wait_until_delivered(std::chrono::milliseconds timeout) {
    return writer_.wait_until_delivered(timeout);
  }

  PublisherCounters counters() const { return writer_.counters(); }

 private:
  const TopicProfile& profile_;
  ByteWriter writer_;
};

}  // namespace cosight::transport
