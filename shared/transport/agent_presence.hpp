#pragma once

#include <atomic>
#include <cstdint>
#include <memory>
#include <string>

#include "shared/transport/participant.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

/// What an agent says of itself with every heartbeat.
struct AgentProgress {
  std::uint64_t frames_sent = 0;
  std::uint64_t orientations_sent = 0;
  SourceCounters frames;
  SourceCounters orientations;
};

/// Whether the sender of `heartbeat` has been there longer than the instance that has made `own_beats`
/// heartbeats. Of two that started within half a second of each other the smaller instance id counts as the
/// older one, so that both come to the same answer.
bool is_older(const HeartbeatSample& heartbeat, std::uint64_t own_beats, std::uint64_t own_instance);

/// Beats ten times a second on a thread of its own, and listens for another agent that beats under the same
/// id: of two the one that came later has to go.
class AgentPresence {
 public:
  /// Throws TransportError.
  AgentPresence(const Participant& participant, const Topic<HeartbeatSample>& topic, std::string agent_id);
  ~AgentPresence();
  AgentPresence(const AgentPresence&) = delete;
  AgentPresence& operator=(const AgentPresence&) = delete;

  void update(const AgentProgress& progress);

  /// An agent of this id was there before: logged once, with what to do.
  bool has_older_namesake() const;

  /// How many agents of this id have come since, and been told to go by their own listening.
  std::uint64_t newer_namesakes() const;

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace cosight::transport
