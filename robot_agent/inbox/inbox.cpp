#include "robot_agent/inbox/inbox.hpp"

#include <algorithm>
#include <chrono>
#include <utility>
#include <variant>

#include "robot_agent/inbox/frame_decoder.hpp"

namespace cosight::inbox {

Inbox::Inbox(const InboxOptions& options, ArrivalClock clock)
    : clock_(std::move(clock)),
      robot_size_(options.robot_size),
      camera_F_(options.camera_F),
      session_(options.pairing.wearer_silence),
      pairing_(options.pairing, options.interpolation, options.mounting) {}

Inbox::ArrivalClock Inbox::steady_arrival_clock() {
  return [] {
    const auto since_start = std::chrono::steady_clock::now().time_since_epoch();
    return Stamp{std::chrono::duration_cast<std::chrono::nanoseconds>(since_start).count()};
  };
}

void Inbox::push_robot_frame(ImageSample frame) {
  frame.stamp = stamps_.from_robot(frame.stamp);
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_();
  robot_delay_.note(now - frame.stamp);
  pairing_.add_robot_frame(std::move(frame), now);
  arrived_.notify_one();
}

void Inbox::push_wearer_frame(ImageSample frame, const PeerId& peer) {
  frame.stamp = stamps_.from_wearer(frame.stamp);
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_();
  if (!admit(peer, now)) return;
  worn_delay_.note(now - frame.stamp);
  pairing_.add_worn_frame(std::move(frame), now);
  arrived_.notify_one();
}

bool Inbox::push_ahrs(AhrsSample sample, const PeerId& peer) {
  sample.stamp = stamps_.from_wearer(sample.stamp);
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_();
  if (!admit(peer, now)) return false;
  pairing_.add_ahrs(sample, now);
  arrived_.notify_one();
  return true;
}

void Inbox::push_wearer_pose(WearerPoseSample sample) {
  sample.stamp = stamps_.from_robot(sample.stamp);
  const std::lock_guard lock(mutex_);
  pairing_.add_pose(sample, clock_());
  arrived_.notify_one();
}

void Inbox::push_no_wearer_pose(Stamp stamp) {
  const std::lock_guard lock(mutex_);
  pairing_.add_no_pose(stamps_.from_robot(stamp), clock_());
  arrived_.notify_one();
}

void Inbox::push_wearer_heartbeat(const PeerId& peer) {
  const std::lock_guard lock(mutex_);
  const Stamp now = clock_();
  if (admit(peer, now)) pairing_.wearer_is_alive(now);
}

void Inbox::wearer_gone(const PeerId& peer) {
  const std::lock_guard lock(mutex_);
  if (!session_.gone(peer)) return;
  pairing_.wearer_is_gone();
  arrived_.notify_one();
}

void Inbox::push(Sample sample) {
  if (auto* frame = std::get_if<ImageSample>(&sample)) push_robot_frame(std::move(*frame));
  if (auto* ahrs = std::get_if<AhrsSample>(&sample)) push_ahrs(*ahrs);
  if (auto* pose = std::get_if<WearerPoseSample>(&sample)) push_wearer_pose(*pose);
}

void Inbox::close() {
  const std::lock_guard lock(mutex_);
  closed_ = true;
  arrived_.notify_all();
  taken_.notify_all();
}

bool Inbox::wait_for_room(Stamp timeout) {
  std::unique_lock lock(mutex_);
  return taken_.wait_for(lock, std::chrono::nanoseconds(timeout),
                         [this] { return closed_ || pairing_.has_room(); });
}

std::optional<FrameBundle> Inbox::pop(Stamp timeout) {
  auto paired = wait_for_paired(timeout);
  if (!paired) return std::nullopt;
  taken_.notify_one();
  return decode(std::move(*paired));
}

bool Inbox::finished() const {
  const std::lock_guard lock(mutex_);
  return closed_ && pairing_.queued_robot_frames() == 0;
}

void Inbox::set_wearer_camera(const CameraModel& camera_F) {
  const std::lock_guard lock(mutex_);
  camera_F_ = camera_F;
}

InboxCounters Inbox::counters() const {
  const std::lock_guard lock(mutex_);
  InboxCounters counters = pairing_.counters();
  counters.robot_undecodable = edge_counters_.robot_undecodable;
  counters.robot_wrong_size = edge_counters_.robot_wrong_size;
  counters.worn_undecodable = edge_counters_.worn_undecodable;
  counters.worn_wrong_size = edge_counters_.worn_wrong_size;
  counters.no_calibration = edge_counters_.no_calibration;
  counters.second_wearer = edge_counters_.second_wearer;
  return counters;
}

std::optional<Stamp> Inbox::worn_behind() const {
  const std::lock_guard lock(mutex_);
  if (!robot_delay_.mean() || !worn_delay_.mean()) return std::nullopt;
  return *worn_delay_.mean() - *robot_delay_.mean();
}

bool Inbox::admit(const PeerId& peer, Stamp now) {
  const Admission admission = session_.admit(peer, now);
  if (admission == Admission::kRestarted) pairing_.wearer_restarted();
  if (admission == Admission::kRefused) ++edge_counters_.second_wearer;
  return admission != Admission::kRefused;
}

std::optional<PairedFrame> Inbox::wait_for_paired(Stamp timeout) {
  std::unique_lock lock(mutex_);
  const Stamp give_up = clock_() + timeout;
  while (true) {
    const Stamp now = clock_();
    if (auto paired = pairing_.next(now)) return paired;
    if (now >= give_up || (closed_ && pairing_.queued_robot_frames() == 0)) return std::nullopt;
    const Stamp wake = std::min(give_up, pairing_.deadline().value_or(give_up));
    arrived_.wait_for(lock, std::chrono::nanoseconds(std::max<Stamp>(wake - now, 0)));
  }
}

FrameBundle Inbox::decode(PairedFrame paired) {
  const auto start = std::chrono::steady_clock::now();
  FrameBundle bundle;
  bundle.stamp = paired.frame.stamp;
  bundle.sequence = paired.frame.sequence;
  bundle.wearer_pose_missing = paired.wearer_pose_missing;
  if (!paired.image_dropped) {
    bundle.image = decode_image(paired.frame, robot_size_, &InboxCounters::robot_undecodable,
                                &InboxCounters::robot_wrong_size);
  }
  if (paired.worn) bundle.wearer = decode_worn(*paired.worn);
  bundle.decode_ms =
      std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
  return bundle;
}

std::shared_ptr<const GrayImage> Inbox::decode_image(const ImageSample& frame, const ImageSize& expected,
                                                     Count undecodable, Count wrong_size) {
  DecodedFrame decoded = decode_frame(frame, expected);
  if (!decoded.image) {
    const std::lock_guard lock(mutex_);
    ++(edge_counters_.*(decoded.wrong_size ? wrong_size : undecodable));
  }
  return std::move(decoded.image);
}

std::optional<WearerView> Inbox::decode_worn(const WornMatch& worn) {
  std::optional<CameraModel> camera_F;
  {
    const std::lock_guard lock(mutex_);
    camera_F = camera_F_;
    if (!camera_F) ++edge_counters_.no_calibration;
  }
  if (!camera_F) return std::nullopt;
  auto image = decode_image(worn.frame, {camera_F->width, camera_F->height}, &InboxCounters::worn_undecodable,
                            &InboxCounters::worn_wrong_size);
  if (!image) return std::nullopt;
  WearerView view;
  view.stamp = worn.frame.stamp;
  view.image = std::move(image);
  view.camera = *camera_F;
  view.T_SF = worn.pose.T_SF;
  view.has_orientation = worn.pose.has_orientation;
  if (worn.q_WF) {
    view.q_WF = worn.q_WF->q;
    view.q_WF_covariance = worn.q_WF->covariance;
  }
  return view;
}

}  // namespace cosight::inbox
