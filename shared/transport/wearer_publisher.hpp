#pragma once

#include <chrono>
#include <cstdint>
#include <functional>

#include "shared/dataset/sample.hpp"
#include "shared/transport/publisher.hpp"

namespace cosight::transport {

struct SentCounters {
  std::uint64_t frames = 0;
  std::uint64_t orientations = 0;
  std::uint64_t bytes = 0;      ///< of payload, all topics but the heartbeat
  std::uint64_t not_taken = 0;  ///< the middleware refused or failed
};

/// The wearable's topics. The camera info is latched: who comes later gets it too.
class WearerPublisher {
 public:
  /// Throws TransportError.
  WearerPublisher(const Participant& participant, ImageEncoding encoding);

  void publish(const CameraModel& camera, Stamp stamp);
  void publish(const Sample& sample);

  /// A reader of frames has matched, and one of orientations, if there is any, within half a second of it.
  bool wait_for_robot(std::chrono::milliseconds timeout) const;
  int frame_readers() const { return images_.counters().readers; }

  /// Everything sent has been acknowledged, or the time is up.
  bool wait_until_delivered(std::chrono::milliseconds timeout);

  SentCounters sent() const;

 private:
  Publisher<ImageSample> images_;
  Publisher<AhrsSample> orientations_;
  Publisher<CameraInfoSample> camera_info_;
};

}  // namespace cosight::transport
