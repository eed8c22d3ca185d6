#pragma once

#include <netinet/in.h>
#include <sys/socket.h>
#include <unistd.h>

#include <chrono>
#include <condition_variable>
#include <cstdint>
#include <mutex>
#include <utility>
#include <vector>

#include "shared/transport/participant.hpp"
#include "shared/transport/subscriber.hpp"

namespace cosight::transport {

using namespace std::chrono_literals;  // NOLINT(google-build-using-namespace): test code

/// Whether nobody on this machine listens for participants of that domain. DDS shares the port; who does not
/// share gets it only when it is free.
inline bool is_free(int domain) {
  const int socket_fd = socket(AF_INET, SOCK_DGRAM | SOCK_CLOEXEC, 0);
  sockaddr_in address{};
  address.sin_family = AF_INET;
  address.sin_port = htons(static_cast<std::uint16_t>(7400 + 250 * domain));
  const bool free = bind(socket_fd, reinterpret_cast<const sockaddr*>(&address), sizeof address) == 0;
  close(socket_fd);
  return free;
}

/// A domain for this process that nobody else uses. Tests take 1 to 99, the scripts those above; below 101
/// the ports stay out of the ephemeral range.
inline int own_domain() {
  static const int domain = [] {
    const int first = static_cast<int>(getpid() % 99);
    for (int i = 0; i < 99; ++i) {
      if (const int candidate = 1 + (first + i) % 99; is_free(candidate)) return candidate;
    }
    return 1 + first;
  }();
  return domain;
}

inline ParticipantOptions loopback(const char* name) {
  ParticipantOptions options;
  options.domain = own_domain();
  options.name = name;
  options.interfaces = {"lo"};
  return options;
}

/// Everything that a subscriber received.
template <class Sample>
class InboxOf {
 public:
  struct Received {
    Sample sample;
    Reception reception;
  };

  InboxOf(const Participant& participant, const Topic<Sample>& topic)
      : subscriber(participant, topic, [this](Sample&& sample, const Reception& reception) {
          const std::lock_guard lock(mutex_);
          received_.push_back({std::move(sample), reception});
          arrived_.notify_all();
        }) {}

  bool wait_for(std::size_t samples, std::chrono::milliseconds timeout = 5000ms) {
    std::unique_lock lock(mutex_);
    return arrived_.wait_for(lock, timeout, [&] { return received_.size() >= samples; });
  }

  std::vector<Received> received() const {
    const std::lock_guard lock(mutex_);
    return received_;
  }

 private:
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::vector<Received> received_;

 public:
  Subscriber<Sample> subscriber;  ///< last: its callback uses all of the above
};

/// Waits until `condition` holds.
template <class Condition>
bool eventually(Condition condition, std::chrono::milliseconds timeout = 5000ms) {
  const auto end = std::chrono::steady_clock::now() + timeout;
  while (!condition()) {
    if (std::chrono::steady_clock::now() > end) return false;
    usleep(5000);
  }
  return true;
}

}  // namespace cosight::transport
