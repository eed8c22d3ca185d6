#pragma once

#include <atomic>
#include <cstdint>

#include "shared/transport/participant.hpp"
#include "sim/simulated_run.hpp"

namespace cosight::sim {

struct LiveOptions {
  transport::ParticipantOptions dds;
  double rate = 1.0;           ///< times real time
  double wait = 30.0;          ///< for readers of both cameras' frames, before the first one [s]
  bool tracks_wearer = false;  ///< publishes the tracker's poses of the worn camera too
  unsigned threads = 2;        ///< that render, at least one a camera
};

/// What one of the two said.
struct LiveStream {
  std::uint64_t samples = 0;
  std::uint64_t frames = 0;
  std::uint64_t late = 0;       ///< frames over 50 ms behind their time: the renderer was too slow
  double worst_lateness = 0.0;  ///< of a frame [s]
};

struct LiveReport {
  LiveStream robot;
  LiveStream wearer;
  bool had_readers = false;  ///< of both cameras
};

/// Publishes what both agents' sensors say, in the rhythm of their stamps, as drivers and a wearable in
/// processes of their own would: `robot_agent --from-topics` can't tell. Until the end of the run or `stop`.
/// Throws TransportError.
LiveReport play_live(const SimulatedRun& run, const LiveOptions& options, const std::atomic<bool>& stop);

}  // namespace cosight::sim
