#include "shared/transport/robot_publisher.hpp"

#include "shared/transport/codec.hpp"
#include "shared/transport/matching.hpp"

namespace cosight::transport {
namespace {

/// As it is when it can't be said.
template <class Kind>
void pass_through_message(const Topic<Kind>& topic, Kind& sample) {
  std::vector<std::uint8_t> payload;
  if (encode(sample, topic.profile, payload) != Fault::kNone) return;
  Kind received;
  if (decode(payload, topic.profile, received) == Fault::kNone) sample = std::move(received);
}

}  // namespace

RobotPublisher::RobotPublisher(const Participant& participant, ImageEncoding encoding, bool tracks_wearer)
    : frames_(participant,
              encoding == ImageEncoding::kMono8 ? topics::kRobotImage : topics::kRobotImageCompressed),
      camera_info_(participant, topics::kRobotCameraInfo),
      front_scans_(participant, topics::kRobotLaserFront),
      rear_scans_(participant, topics::kRobotLaserRear),
      imu_(participant, topics::kRobotImu),
      odometry_(participant, topics::kRobotWheelOdometry) {
  if (tracks_wearer) poses_.emplace(participant, topics::kRobotWearerPose);
}

void RobotPublisher::publish(const CameraModel& camera, Stamp stamp) {
  camera_info_.publish({stamp, camera});
}

void RobotPublisher::publish(const Sample& sample) {
  if (const auto* const frame = std::get_if<ImageSample>(&sample)) frames_.publish(*frame);
  if (const auto* const imu = std::get_if<ImuSample>(&sample)) imu_.publish(*imu);
  if (const auto* const odometry = std::get_if<WheelOdometrySample>(&sample)) odometry_.publish(*odometry);
  if (const auto* const pose = std::get_if<WearerPoseSample>(&sample); pose && poses_) poses_->publish(*pose);
  if (const auto* const scan = std::get_if<LaserScanSample>(&sample)) {
    (scan->laser == frames::kLaserRear ? rear_scans_ : front_scans_).publish(*scan);
  }
}

bool RobotPublisher::wait_for_robot(std::chrono::milliseconds timeout) const {
  if (!frames_.wait_for_readers(1, timeout)) return false;
  wait_for_further_readers(front_scans_, rear_scans_, imu_, odometry_);
  if (poses_) wait_for_further_readers(*poses_);
  return true;
}

bool RobotPublisher::wait_until_delivered(std::chrono::milliseconds timeout) {
  return frames_.wait_until_delivered(timeout);
}

std::vector<std::pair<std::string_view, PublisherCounters>> RobotPublisher::counters() const {
  std::vector<std::pair<std::string_view, PublisherCounters>> all = {
      {"dds_robot_image", frames_.counters()},
      {"dds_robot_laser_front", front_scans_.counters()},
      {"dds_robot_laser_rear", rear_scans_.counters()},
      {"dds_robot_imu", imu_.counters()},
      {"dds_robot_wheel_odometry", odometry_.counters()}};
  if (poses_) all.emplace_back("dds_robot_wearer_pose", poses_->counters());
  return all;
}

Sample as_received(Sample sample) {
  if (auto* const odometry = std::get_if<WheelOdometrySample>(&sample))
    pass_through_message(topics::kRobotWheelOdometry, *odometry);
  if (auto* const pose = std::get_if<WearerPoseSample>(&sample))
    pass_through_message(topics::kRobotWearerPose, *pose);
  return sample;
}

}  // namespace cosight::transport
