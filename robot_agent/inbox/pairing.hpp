#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <cstddef>
#include <cstdint>
#include <deque>
#include <optional>

#include "robot_agent/inbox/counters.hpp"
#include "robot_agent/inbox/interpolation.hpp"
#include "robot_agent/inbox/options.hpp"
#include "robot_agent/inbox/stamped_history.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::inbox {

/// A worn frame with what is known of its pose.
struct WornMatch {
  ImageSample frame;
  WearerPoseSample pose;                     ///< at the frame's stamp
  std::optional<UncertainOrientation> q_WF;  ///< from the AHRS
};

/// A robot frame and its worn frame, still encoded.
struct PairedFrame {
  ImageSample frame;
  bool image_dropped = false;  ///< the queue was full: no bytes
  std::optional<WornMatch> worn;
  bool wearer_pose_missing = false;
};

/// A stream that was heard lately is waited for; one never heard gets the benefit of the doubt at the start.
class Presence {
 public:
  explicit Presence(Stamp silence) : silence_(silence) {}
  void heard(Stamp now) { last_heard_ = now; }
  void begin(Stamp now) { last_heard_ = last_heard_.value_or(now); }
  void gone() { last_heard_ = kLongAgo; }
  bool expected(Stamp now) const { return last_heard_ && now - *last_heard_ < silence_; }

 private:
  static constexpr Stamp kLongAgo = -(Stamp{1} << 62);
  Stamp silence_;
  std::optional<Stamp> last_heard_;
};

/// Which worn frame, which pose belongs to each robot frame, and when waiting for them ends. Free of threads
/// and clocks: stamps are the robot's, `now` is any clock that never goes back, and the result depends on the
/// calls and their order only.
///
/// A robot frame takes the unused worn frame nearest in time within `max_pair_interval`, unless that lies
/// nearer to where the next robot frame is due. Robot frames leave in order, each one exactly once.
class Pairing {
 public:
  Pairing(const PairingOptions& options, const InterpolationOptions& interpolation,
          const MountingOptions& mounting);

  void add_robot_frame(ImageSample frame, Stamp now);
  void add_worn_frame(ImageSample frame, Stamp now);
  void add_ahrs(const AhrsSample& sample, Stamp now);
  void add_pose(const WearerPoseSample& sample, Stamp now);
  /// The source of poses has come as far as `stamp` and has none to give: nobody need wait for it.
  void add_no_pose(Stamp stamp, Stamp now);
  void wearer_is_alive(Stamp now) { wearer_.heard(now); }

  /// The wearer is gone: nothing waits for it. What it sent stays usable.
  void wearer_is_gone();
  /// Another wearer took over: nothing that the old one sent is used any more.
  void wearer_restarted();

  /// The oldest robot frame, if it need not wait any longer.
  std::optional<PairedFrame> next(Stamp now);

  /// When the oldest robot frame's waiting ends, whatever comes. Nothing when there is none.
  std::optional<Stamp> deadline() const;

  std::size_t queued_robot_frames() const { return robot_frames_.size(); }
  bool has_room() const;
  const InboxCounters& counters() const { return counters_; }

 private:
  struct PendingFrame {
    ImageSample frame;
    Stamp arrival = 0;
    bool image_dropped = false;
  };
  struct EncodedSize {
    std::size_t images = 0;
    std::size_t bytes = 0;
  };
  using WornFrames = std::deque<ImageSample>;

  bool is_full(const EncodedSize& size) const;
  void drop_robot_images_to_fit();
  void drop_worn_frames_to_fit();
  bool must_wait(const PendingFrame& pending, Stamp now) const;
  bool takes_from_next(const PendingFrame& pending, Stamp worn_stamp) const;
  WornFrames::const_iterator worn_frame_for(const PendingFrame& pending) const;
  void attach_worn_frame(const PendingFrame& pending, PairedFrame& paired);
  void forget_unusable_worn_frames();
  void forget_worn_frames_before(Stamp stamp);
  ImageSample take(const WornFrames::const_iterator& worn);

  PairingOptions options_;
  InterpolationOptions interpolation_;
  MountingOptions mounting_;

  std::deque<PendingFrame> robot_frames_;
  WornFrames worn_frames_;  ///< by stamp
  EncodedSize robot_size_;
  EncodedSize worn_size_;
  StampedHistory<WearerPoseSample> poses_;
  StampedHistory<AhrsSample> ahrs_;
  Presence wearer_;
  Presence pose_source_;
  Presence ahrs_source_;

  std::optional<Stamp> newest_robot_stamp_;
  std::optional<std::uint64_t> robot_sequence_;
  std::optional<std::uint64_t> worn_sequence_;
  std::optional<Stamp> last_worn_stamp_;     ///< in the order of arrival
  std::optional<Stamp> last_decided_stamp_;  ///< of the robot frame that left last
  InboxCounters counters_;
};

}  // namespace cosight::inbox
