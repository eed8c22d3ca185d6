#pragma once

#include <chrono>
#include <functional>
#include <span>
#include <type_traits>
#include <utility>

#include "shared/transport/byte_reader.hpp"

namespace cosight::transport {

/// Receives samples of one topic of `topics`, every one checked: what a peer sends wrong is counted, not
/// delivered.
template <class Sample>
class Subscriber {
 public:
  using Callback = std::function<void(Sample&&, const Reception&)>;
  using Gone = ByteReader::Gone;

  /// `callback` runs on a thread of the middleware, one call at a time, never after the destructor has
  /// returned: it enqueues and leaves. It must not destroy the subscriber. `gone` likewise, when a writer has
  /// left or fallen silent, once or more. Throws TransportError when the middleware refuses the topic.
  Subscriber(const Participant& participant, const Topic<Sample>& topic, Callback callback, Gone gone = {})
      : reader_(
            participant, topic.profile,
            [&profile = topic.profile, callback = std::move(callback)](std::span<const std::uint8_t> payload,
                                                                       const Reception& reception) {
              Sample sample;
              const Fault fault = decode(payload, profile, sample);
              if (fault != Fault::kNone) return fault;
              if constexpr (std::is_same_v<Sample, ImageSample>) sample.sequence = reception.sequence;
              callback(std::move(sample), reception);
              return Fault::kNone;
            },
            std::move(gone)) {}

  /// True as soon as that many writers are matched.
  bool wait_for_writers(int writers, std::chrono::milliseconds timeout) const {
    return reader_.wait_for_writers(writers, timeout);
  }

  SubscriberCounters counters() const { return reader_.counters(); }

 private:
  ByteReader reader_;
};

}  // namespace cosight::transport
