#include "robot_agent/inbox/pairing.hpp"

#include <algorithm>
#include <cstdlib>
#include <utility>

namespace cosight::inbox {
namespace {

constexpr std::size_t kPoseHistory = 1'000;
constexpr std::size_t kAhrsHistory = 2'000;

/// Frames that a jump of the sequence leaves out. A sequence that goes back started anew.
std::uint64_t lost_before(std::optional<std::uint64_t>& last_sequence, std::uint64_t sequence) {
  const std::uint64_t lost =
      last_sequence && sequence > *last_sequence + 1 ? sequence - *last_sequence - 1 : 0;
  last_sequence = sequence;
  return lost;
}

}  // namespace

Pairing::Pairing(const PairingOptions& options, const InterpolationOptions& interpolation,
                 const MountingOptions& mounting)
    : options_(options),
      interpolation_(interpolation),
      mounting_(mounting),
      poses_(kPoseHistory),
      ahrs_(kAhrsHistory),
      wearer_(options.wearer_silence),
      pose_source_(options.pose_silence),
      ahrs_source_(options.wearer_silence) {}

void Pairing::add_robot_frame(ImageSample frame, Stamp now) {
  counters_.robot_lost += lost_before(robot_sequence_, frame.sequence);
  if (newest_robot_stamp_ && frame.stamp <= *newest_robot_stamp_) {
    ++counters_.robot_out_of_order;
    return;
  }
  if (robot_frames_.size() >= options_.max_queued_frames) {
    ++counters_.robot_frames_dropped;
    return;
  }
  if (!newest_robot_stamp_) {
    wearer_.begin(now);
    pose_source_.begin(now);
    ahrs_source_.begin(now);
  }
  newest_robot_stamp_ = frame.stamp;
  ++counters_.robot_frames;
  ++robot_size_.images;
  robot_size_.bytes += frame.bytes.size();
  robot_frames_.push_back({std::move(frame), now, false});
  drop_robot_images_to_fit();
}

void Pairing::add_worn_frame(ImageSample frame, Stamp now) {
  wearer_.heard(now);
  ++counters_.worn_frames;
  counters_.worn_lost += lost_before(worn_sequence_, frame.sequence);
  if (last_worn_stamp_ && frame.stamp <= *last_worn_stamp_) ++counters_.worn_out_of_order;
  if (last_decided_stamp_ && frame.stamp <= *last_decided_stamp_) ++counters_.worn_late;
  last_worn_stamp_ = frame.stamp;
  const auto place =
      std::lower_bound(worn_frames_.begin(), worn_frames_.end(), frame.stamp,
                       [](const ImageSample& other, Stamp stamp) { return other.stamp < stamp; });
  if (place != worn_frames_.end() && place->stamp == frame.stamp) {
    ++counters_.worn_unused;
    return;
  }
  ++worn_size_.images;
  worn_size_.bytes += frame.bytes.size();
  worn_frames_.insert(place, std::move(frame));
  forget_unusable_worn_frames();
  drop_worn_frames_to_fit();
}

void Pairing::add_ahrs(const AhrsSample& sample, Stamp now) {
  wearer_.heard(now);
  ahrs_source_.heard(now);
  if (is_valid(sample)) {
    ++counters_.ahrs_samples;
    ahrs_.insert(sample);
  } else {
    ++counters_.invalid_samples;
  }
}

void Pairing::add_pose(const WearerPoseSample& sample, Stamp now) {
  pose_source_.heard(now);
  if (is_valid(sample)) {
    ++counters_.wearer_poses;
    poses_.insert(sample);
  } else {
    ++counters_.invalid_samples;
  }
}

void Pairing::add_no_pose(Stamp stamp, Stamp now) {
  pose_source_.heard(now);
  poses_.pass(stamp);
}

void Pairing::wearer_is_gone() {
  wearer_.gone();
  ahrs_source_.gone();
}

void Pairing::wearer_restarted() {
  ++counters_.wearer_restarts;
  counters_.worn_unused += worn_frames_.size();
  worn_frames_.clear();
  worn_size_ = {};
  ahrs_.clear();
  worn_sequence_.reset();
  last_worn_stamp_.reset();
}

std::optional<PairedFrame> Pairing::next(Stamp now) {
  if (robot_frames_.empty()) return std::nullopt;
  PendingFrame& pending = robot_frames_.front();
  const bool waited_enough = now - pending.arrival >= options_.max_wait;
  if (must_wait(pending, now)) {
    if (!waited_enough) return std::nullopt;
    ++counters_.wait_timeouts;
  }
  PairedFrame paired;
  if (!pending.image_dropped) {
    attach_worn_frame(pending, paired);
    --robot_size_.images;
    robot_size_.bytes -= pending.frame.bytes.size();
  }
  last_decided_stamp_ = pending.frame.stamp;
  paired.frame = std::move(pending.frame);
  paired.image_dropped = pending.image_dropped;
  robot_frames_.pop_front();
  forget_unusable_worn_frames();
  return paired;
}

std::optional<Stamp> Pairing::deadline() const {
  if (robot_frames_.empty()) return std::nullopt;
  return robot_frames_.front().arrival + options_.max_wait;
}

bool Pairing::has_room() const {
  // Half of the room is kept for what is already on its way.
  return 2 * robot_size_.images < options_.max_queued_images &&
         2 * robot_size_.bytes < options_.max_queued_bytes;
}

bool Pairing::is_full(const EncodedSize& size) const {
  return size.images > options_.max_queued_images || size.bytes > options_.max_queued_bytes;
}

void Pairing::drop_robot_images_to_fit() {
  for (PendingFrame& pending : robot_frames_) {
    if (!is_full(robot_size_)) return;
    if (pending.image_dropped) continue;
    ++counters_.robot_images_dropped;
    --robot_size_.images;
    robot_size_.bytes -= pending.frame.bytes.size();
    pending.image_dropped = true;
    pending.frame.bytes = {};
  }
}

void Pairing::drop_worn_frames_to_fit() {
  while (is_full(worn_size_)) {
    ++counters_.worn_dropped;
    take(worn_frames_.begin());
  }
}

bool Pairing::must_wait(const PendingFrame& pending, Stamp now) const {
  if (pending.image_dropped) return false;
  const bool wearer_passed = last_worn_stamp_ && *last_worn_stamp_ >= pending.frame.stamp;
  if (!wearer_passed && wearer_.expected(now)) return true;
  const auto worn = worn_frame_for(pending);
  if (worn == worn_frames_.end()) return false;
  if (pose_source_.expected(now) && !poses_.reaches(worn->stamp)) return true;
  return ahrs_source_.expected(now) && !ahrs_.reaches(worn->stamp);
}

/// The next robot frame is due one interval after this one. Its actual stamp is not asked even when known, or
/// the pairs would depend on how fast frames are taken out.
bool Pairing::takes_from_next(const PendingFrame& pending, Stamp worn_stamp) const {
  if (!last_decided_stamp_) return false;
  const Stamp stamp = pending.frame.stamp;
  const Stamp next_stamp = stamp + (stamp - *last_decided_stamp_);
  return std::abs(next_stamp - worn_stamp) < worn_stamp - stamp;
}

Pairing::WornFrames::const_iterator Pairing::worn_frame_for(const PendingFrame& pending) const {
  const Stamp stamp = pending.frame.stamp;
  const auto after = std::lower_bound(worn_frames_.begin(), worn_frames_.end(), stamp,
                                      [](const ImageSample& frame, Stamp s) { return frame.stamp < s; });
  auto nearest = worn_frames_.end();
  Stamp nearest_distance = options_.max_pair_interval + 1;
  if (after != worn_frames_.begin() && stamp - std::prev(after)->stamp < nearest_distance) {
    nearest = std::prev(after);
    nearest_distance = stamp - nearest->stamp;
  }
  if (after != worn_frames_.end() && after->stamp - stamp < nearest_distance &&
      !takes_from_next(pending, after->stamp)) {
    nearest = after;
  }
  return nearest;
}

void Pairing::attach_worn_frame(const PendingFrame& pending, PairedFrame& paired) {
  const auto worn = worn_frame_for(pending);
  if (worn == worn_frames_.end()) {
    ++counters_.no_pair;
    return;
  }
  ImageSample frame = take(worn);
  forget_worn_frames_before(frame.stamp);  // pairs never cross
  const auto pose = interpolate_pose(poses_, frame.stamp, interpolation_);
  if (!pose) {
    ++counters_.no_pose;
    paired.wearer_pose_missing = true;
    return;
  }
  ++counters_.paired;
  paired.worn = WornMatch{std::move(frame), *pose, std::nullopt};
  if (const auto q_WH = interpolate_orientation(ahrs_, pose->stamp, interpolation_)) {
    paired.worn->q_WF = free_camera_orientation(*q_WH, mounting_);
  }
  if (!pose->has_orientation && !paired.worn->q_WF) ++counters_.no_orientation;
}

/// Later robot frames are newer than the last decided one, so a worn frame this old is near to none of them.
void Pairing::forget_unusable_worn_frames() {
  if (last_decided_stamp_) forget_worn_frames_before(*last_decided_stamp_ - options_.max_pair_interval + 1);
}

void Pairing::forget_worn_frames_before(Stamp stamp) {
  while (!worn_frames_.empty() && worn_frames_.front().stamp < stamp) {
    ++counters_.worn_unused;
    take(worn_frames_.begin());
  }
}

ImageSample Pairing::take(const WornFrames::const_iterator& worn) {
  const auto place = worn_frames_.begin() + (worn - worn_frames_.cbegin());
  ImageSample frame = std::move(*place);
  --worn_size_.images;
  worn_size_.bytes -= frame.bytes.size();
  worn_frames_.erase(place);
  return frame;
}

}  // namespace cosight::inbox
