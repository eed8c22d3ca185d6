#include "shared/transport/robot_topic_source.hpp"

#include <algorithm>
#include <utility>

namespace cosight::transport {
namespace {

using std::chrono::milliseconds;

constexpr milliseconds kSlice{50};

// Samples that nobody asks for: the robot may wait for its wearer, and then wants to see what is now.
constexpr std::chrono::seconds kKept{3};

}  // namespace

RobotTopicSource::RobotTopicSource(const Participant& participant, double end_after,
                                   const std::atomic<bool>& stop)
    : end_after_(std::chrono::duration_cast<Clock::duration>(std::chrono::duration<double>(end_after))),
      stop_(stop),
      compressed_(participant, topics::kRobotImageCompressed,
                  [this](ImageSample&& sample, const Reception&) { push(std::move(sample)); }),
      raw_(participant, topics::kRobotImage,
           [this](ImageSample&& sample, const Reception&) { push(std::move(sample)); }),
      front_(participant, topics::kRobotLaserFront,
             [this](LaserScanSample&& sample, const Reception&) { push(std::move(sample)); }),
      rear_(participant, topics::kRobotLaserRear,
            [this](LaserScanSample&& sample, const Reception&) { push(std::move(sample)); }),
      imu_(participant, topics::kRobotImu,
           [this](ImuSample&& sample, const Reception&) { push(std::move(sample)); }),
      odometry_(participant, topics::kRobotWheelOdometry,
                [this](WheelOdometrySample&& sample, const Reception&) { push(std::move(sample)); }) {}

void RobotTopicSource::push(Sample sample) {
  const std::lock_guard lock(mutex_);
  const Clock::time_point now = Clock::now();
  had_frames_ |= kind_of(sample) == SampleKind::kImage;
  queue_.push_back({now, std::move(sample)});
  while (now - queue_.front().time > kKept)
    queue_.pop_front();
  arrived_.notify_one();
}

std::optional<Sample> RobotTopicSource::next() {
  std::unique_lock lock(mutex_);
  while (queue_.empty()) {
    if (stop_) return std::nullopt;
    const Clock::time_point now = Clock::now();
    if (frame_writers() > 0 || !had_frames_) publisher_seen_ = now;
    if (end_after_ > Clock::duration::zero() && now - publisher_seen_ >= end_after_) return std::nullopt;
    arrived_.wait_for(lock, kSlice, [this] { return !queue_.empty(); });
  }
  if (stop_) return std::nullopt;
  Sample sample = std::move(queue_.front().sample);
  queue_.pop_front();
  ++counters_[static_cast<std::size_t>(kind_of(sample))].delivered;
  return sample;
}

SourceCounters RobotTopicSource::counters(SampleKind kind) const {
  const std::lock_guard lock(mutex_);
  return counters_[static_cast<std::size_t>(kind)];
}

std::optional<CameraModel> receive_robot_camera(const Participant& participant, milliseconds timeout,
                                                const std::atomic<bool>& stop) {
  std::mutex mutex;
  std::condition_variable arrived;
  std::optional<CameraModel> camera;
  const Subscriber<CameraInfoSample> subscriber(participant, topics::kRobotCameraInfo,
                                                [&](CameraInfoSample&& sample, const Reception&) {
                                                  const std::lock_guard lock(mutex);
                                                  camera = sample.camera;
                                                  arrived.notify_one();
                                                });
  const auto give_up = std::chrono::steady_clock::now() + timeout;
  std::unique_lock lock(mutex);
  while (!camera && !stop && std::chrono::steady_clock::now() < give_up)
    arrived.wait_for(lock, kSlice);
  return camera;
}

}  // namespace cosight::transport
