#pragma once

#include <cstddef>
#include <cstdint>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

namespace cosight::transport {

/// Something outside failed at start-up: a profile file, an interface, the domain. Says which and what to do.
class TransportError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

struct ParticipantOptions {
  int domain = 0;                ///< DDS domain, [0, 232]; both agents need the same
  std::string name = "cosight";  ///< shown by DDS tools
  /// Fast DDS XML profiles, besides FASTRTPS_DEFAULT_PROFILES_FILE. A participant profile named "cosight" or
  /// the file's default one, and data_writer and data_reader profiles named as a topic, replace what is set
  /// here.
  std::string profile_file;
  bool shared_memory = false;           ///< besides UDP; segments of a killed process stay in /dev/shm
  std::vector<std::string> interfaces;  ///< names or IPv4 addresses; empty: all
  std::vector<std::string> peers;       ///< IPv4 addresses to ask besides multicast
  int max_message_size = 1400;  ///< bytes in one datagram sent [256, 65500]; 65500 when no link loses any
  double max_bytes_per_second = 0.0;  ///< for images and maps together; 0: no limit. 1.2-1.5 x the stream
  int socket_buffer = 4 << 20;        ///< send and receive [bytes]
};

/// Other participants as this one saw them come and go.
struct PeerCounters {
  std::uint64_t discovered = 0;
  std::uint64_t left = 0;  ///< said goodbye
  std::uint64_t lost = 0;  ///< fell silent for longer than their lease
};

/// This process in a DDS domain. Publishers and subscribers keep what they need of it alive.
class Participant {
 public:
  explicit Participant(const ParticipantOptions& options);
  ~Participant();
  Participant(const Participant&) = delete;
  Participant& operator=(const Participant&) = delete;

  /// What will not work as well as it should, one sentence each: already logged.
  const std::vector<std::string>& warnings() const;

  PeerCounters peers() const;

  class Impl;
  const std::shared_ptr<Impl>& impl() const { return impl_; }

 private:
  std::shared_ptr<Impl> impl_;
};

}  // namespace cosight::transport
