#pragma once

#include <array>
#include <atomic>
#include <chrono>
#include <condition_variable>
#include <deque>
#include <mutex>

#include "shared/dataset/sample_source.hpp"
#include "shared/transport/subscriber.hpp"

namespace cosight::transport {

/// The robot's camera, lasers, IMU and wheels when they speak by topics: a driver, a simulator or a replay in
/// another process, which this side can't tell apart.
class RobotTopicSource : public SampleSource {
 public:
  /// `next` ends the stream when frames have come and nobody has published them for `end_after` [s] (0:
  /// never), or when `stop` is set. `participant` and `stop` have to outlive this. Throws TransportError.
  RobotTopicSource(const Participant& participant, double end_after, const std::atomic<bool>& stop);

  std::optional<Sample> next() override;
  SourceCounters counters(SampleKind kind) const override;
  using SampleSource::counters;
  std::string description() const override { return "the robot's topics"; }

 private:
  using Clock = std::chrono::steady_clock;
  struct Arrived {
    Clock::time_point time;
    Sample sample;
  };

  void push(Sample sample);
  int frame_writers() const { return compressed_.counters().writers + raw_.counters().writers; }

  Clock::duration end_after_;
  const std::atomic<bool>& stop_;
  mutable std::mutex mutex_;
  std::condition_variable arrived_;
  std::deque<Arrived> queue_;
  std::array<SourceCounters, kSampleKinds> counters_{};
  bool had_frames_ = false;
  Clock::time_point publisher_seen_;  ///< when frames last had a writer

  Subscriber<ImageSample> compressed_;
  Subscriber<ImageSample> raw_;
  Subscriber<LaserScanSample> front_;
  Subscriber<LaserScanSample> rear_;
  Subscriber<ImuSample> imu_;
  Subscriber<WheelOdometrySample> odometry_;  ///< last: the callbacks use all of the above
};

/// The robot's camera as its topic tells. Nothing when it is not told in time, or `stop` is set.
std::optional<CameraModel> receive_robot_camera(const Participant& participant,
                                                std::chrono::milliseconds timeout,
                                                const std::atomic<bool>& stop);

}  // namespace cosight::transport
