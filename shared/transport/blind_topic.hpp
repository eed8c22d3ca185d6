#pragma once

#include <array>
#include <chrono>
#include <cstdint>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

#include "shared/dataset/stamp.hpp"
#include "shared/transport/participant.hpp"

namespace cosight::transport {

/// The part of a writer's quality of service that its readers have to match.
struct BlindQos {
  bool reliable = true;
  bool transient_local = true;
  double liveliness_lease = 0.0;  ///< [s]; 0: none
  double deadline = 0.0;          ///< [s]; 0: none
  bool exclusive = false;         ///< ownership
  std::vector<std::string> partitions;
  bool operator==(const BlindQos&) const = default;
};

/// A topic of which nothing is known but what a writer announced.
struct BlindTopic {
  std::string name;  ///< DDS name: "rt/cosight/robot/imu"
  std::string type;  ///< "sensor_msgs::msg::dds_::Imu_"
  bool keyed = false;
  BlindQos qos;
};

/// A writer of another participant in the domain.
struct DiscoveredWriter {
  std::array<std::uint8_t, 16> id{};  ///< GUID
  BlindTopic topic;
};

/// All that are there now.
std::vector<DiscoveredWriter> discovered_writers(const Participant& participant);

struct BlindReception {
  Stamp stamp = 0;         ///< of this host's clock, on arrival
  Stamp source_stamp = 0;  ///< of the writer's
  std::array<std::uint8_t, 16> writer_id{};
  std::uint64_t sequence = 0;  ///< counts per writer from 1
};

/// Receives a topic's payloads as they were on the wire, with their 4-byte encapsulation.
class BlindReader {
 public:
  using Receive = std::function<void(std::vector<std::uint8_t>&& payload, const BlindReception&)>;

  /// Asks for what `topic.qos` offers. `receive` runs on a thread of the middleware, one call at a time,
  /// until the destructor returns. Never made inside a callback of the middleware. Throws TransportError.
  BlindReader(const Participant& participant, const BlindTopic& topic, Receive receive);
  ~BlindReader();
  BlindReader(const BlindReader&) = delete;
  BlindReader& operator=(const BlindReader&) = delete;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

/// Sends payloads as they are.
class BlindWriter {
 public:
  /// Offers `topic.qos`; a reliable one keeps the last `depth` samples for readers that come late, for the
  /// reason that TopicProfile gives. Throws TransportError.
  BlindWriter(const Participant& participant, const BlindTopic& topic, int depth);
  ~BlindWriter();
  BlindWriter(const BlindWriter&) = delete;
  BlindWriter& operator=(const BlindWriter&) = delete;

  /// With the stamp that the original writer gave it. False: the middleware did not take it.
  bool write(std::span<const std::uint8_t> payload, Stamp source_stamp);

  int readers() const;  ///< matched at present
  bool wait_until_delivered(std::chrono::milliseconds timeout);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::transport
