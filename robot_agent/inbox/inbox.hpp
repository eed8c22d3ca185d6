#pragma once

#include <condition_variable>
#include <cstdint>
#include <functional>
#include <memory>
#include <mutex>
#include <optional>

#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/inbox/arrival_delay.hpp"
#include "robot_agent/inbox/counters.hpp"
#include "robot_agent/inbox/options.hpp"
#include "robot_agent/inbox/pairing.hpp"
#include "robot_agent/inbox/stamp_mapping.hpp"
#include "robot_agent/inbox/wearer_session.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::inbox {

/// Where everything asynchronous ends: samples come in from any thread in any order, one `FrameBundle` a
/// robot frame goes out to the one estimating thread. Pushing takes microseconds and never fails; what can't
/// be used is counted. Decoding happens in the thread that pops.
class Inbox {
 public:
  /// Time of arrival [ns], never going back; stands beside the stamps and is never mixed with them.
  using ArrivalClock = std::function<Stamp()>;

  explicit Inbox(const InboxOptions& options, ArrivalClock clock = steady_arrival_clock());
  static ArrivalClock steady_arrival_clock();

  void push_robot_frame(ImageSample frame);
  void push_wearer_frame(ImageSample frame, const PeerId& peer = {});
  /// False when it is not the wearer's: another process is, and alive.
  bool push_ahrs(AhrsSample sample, const PeerId& peer = {});
  void push_wearer_pose(WearerPoseSample sample);
  /// Whoever locates the wearer has come as far as `stamp`, and does not know.
  void push_no_wearer_pose(Stamp stamp);
  void push_wearer_heartbeat(const PeerId& peer);
  /// The process left, or its liveliness was lost: nothing waits for it, and another may take its place.
  void wearer_gone(const PeerId& peer);

  /// Dispatches by type: for a `SampleSource` on the robot's side.
  void push(Sample sample);

  /// No more robot frames will come; what is queued still goes out.
  void close();

  /// Blocks while the robot's queue is half full: for a source that can be read faster than real time.
  /// Returns false when `timeout` passed first.
  bool wait_for_room(Stamp timeout);

  /// The next robot frame, waiting at most `timeout` for it. Nothing: none yet, or `finished()`.
  std::optional<FrameBundle> pop(Stamp timeout);

  /// Closed, and every frame has gone out.
  bool finished() const;

  /// Calibration of the worn camera, once it is known; without it no worn frame can be used.
  void set_wearer_camera(const CameraModel& camera_F);
  StampMapping& stamps() { return stamps_; }
  InboxCounters counters() const;

  /// How much longer than the robot's frames the worn ones take from their stamp to their arrival, smoothed
  /// [ns]: what the link costs, and the clocks' offset as far as it is not known. Nothing before both came.
  std::optional<Stamp> worn_behind() const;

 private:
  using Count = std::uint64_t InboxCounters::*;

  bool admit(const PeerId& peer, Stamp now);
  std::optional<PairedFrame> wait_for_paired(Stamp timeout);
  FrameBundle decode(PairedFrame paired);
  std::shared_ptr<const GrayImage> decode_image(const ImageSample& frame, const ImageSize& expected,
                                                Count undecodable, Count wrong_size);
  std::optional<WearerView> decode_worn(const WornMatch& worn);

  StampMapping stamps_;
  ArrivalClock clock_;
  ImageSize robot_size_;

  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::condition_variable taken_;
  std::optional<CameraModel> camera_F_;
  WearerSession session_;
  Pairing pairing_;
  InboxCounters
      edge_counters_;  ///< undecodable, wrong size, no calibration, second wearer; the rest is the pairing's
  bool closed_ = false;
  ArrivalDelay robot_delay_;
  ArrivalDelay worn_delay_;
};

}  // namespace cosight::inbox
