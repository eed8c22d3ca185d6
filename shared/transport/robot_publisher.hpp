#pragma once

#include <chrono>
#include <optional>
#include <string_view>
#include <utility>
#include <vector>

#include "shared/dataset/sample.hpp"
#include "shared/transport/publisher.hpp"

namespace cosight::transport {

/// The robot's own sensors on their topics. The camera info is latched: who comes later gets it too.
class RobotPublisher {
 public:
  /// `tracks_wearer`: it has poses of the worn camera to tell. Throws TransportError.
  RobotPublisher(const Participant& participant, ImageEncoding encoding, bool tracks_wearer);

  void publish(const CameraModel& camera, Stamp stamp);
  void publish(const Sample& sample);

  /// A reader of frames has matched, and those of the other sensors, if there are any, within a second of it.
  bool wait_for_robot(std::chrono::milliseconds timeout) const;

  /// Every frame sent has been acknowledged, or the time is up.
  bool wait_until_delivered(std::chrono::milliseconds timeout);

  /// Of each topic, under the name of its section in a summary.
  std::vector<std::pair<std::string_view, PublisherCounters>> counters() const;

 private:
  Publisher<ImageSample> frames_;
  Publisher<CameraInfoSample> camera_info_;
  Publisher<LaserScanSample> front_scans_;
  Publisher<LaserScanSample> rear_scans_;
  Publisher<ImuSample> imu_;
  Publisher<WheelOdometrySample> odometry_;
  std::optional<Publisher<WearerPoseSample>> poses_;
};

/// The sample as whoever listens on its topic gets it: going through a message moves the last digit of the
/// odometry's yaw and of a pose's quaternion.
Sample as_received(Sample sample);

}  // namespace cosight::transport
