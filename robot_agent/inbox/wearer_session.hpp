#pragma once

#include <algorithm>
#include <array>
#include <cstdint>
#include <optional>

#include "shared/dataset/stamp.hpp"

namespace cosight::inbox {

/// Identity of the process that a sample came from: the prefix of its DDS participant's GUID, new at each
/// start; all zero for a source inside this process.
using PeerId = std::array<std::uint8_t, 12>;

/// Of a writer's GUID: all writers of one process share the prefix.
constexpr PeerId peer_of(const std::array<std::uint8_t, 16>& writer_guid) {
  PeerId peer{};
  std::copy_n(writer_guid.begin(), peer.size(), peer.begin());
  return peer;
}

enum class Admission {
  kAccepted,
  kRestarted,  ///< accepted, and the first of another process: the one before had gone or fallen silent
  kRefused,    ///< another process is the wearer, and alive
};

/// Which of the processes that call themselves this wearer is believed: the first, until it has gone or is
/// silent for `silence`.
class WearerSession {
 public:
  explicit WearerSession(Stamp silence) : silence_(silence) {}

  Admission admit(const PeerId& peer, Stamp now);

  /// The process left or lost its liveliness. Returns whether it was the wearer.
  bool gone(const PeerId& peer);

 private:
  Stamp silence_;
  std::optional<PeerId> wearer_;
  Stamp last_heard_ = 0;
  bool wearer_gone_ = false;
};

}  // namespace cosight::inbox
