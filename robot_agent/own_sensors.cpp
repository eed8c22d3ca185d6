#include "robot_agent/own_sensors.hpp"

#include "robot_agent/outbox/publisher.hpp"

namespace cosight::robot {

OwnSensors::OwnSensors(const AgentInput& input, const ReplayOptions& replay,
                       const transport::Participant& participant, Intake& intake, inbox::Inbox& inbox,
                       const std::atomic<bool>& stop)
    : camera_(input.camera),
      as_fast_as_possible_(!input.live && replay.rate <= 0.0),
      intake_(intake),
      inbox_(inbox),
      stop_(stop),
      source_(input.live ? input.open() : std::make_unique<PacedReplay>(input.open, replay, clock_, stop)),
      frames_(participant, transport::topics::kRobotImageCompressed),
      calibration_(participant, transport::topics::kRobotCameraInfo),
      front_scans_(participant, transport::topics::kRobotLaserFront),
      rear_scans_(participant, transport::topics::kRobotLaserRear),
      imu_(participant, transport::topics::kRobotImu),
      odometry_(participant, transport::topics::kRobotWheelOdometry) {
  if (input.has_wearer_pose && intake.takes_tracked_poses()) {
    poses_.emplace(participant, transport::topics::kRobotWearerPose);
  }
}

OwnSensors::~OwnSensors() {
  if (thread_.joinable()) thread_.join();
}

void OwnSensors::start() {
  thread_ = std::thread([this] { play(); });
}

void OwnSensors::play() {
  bool is_first = true;
  while (auto sample = source_->next()) {
    if (is_first) calibration_.publish({stamp_of(*sample), camera_});
    is_first = false;
    publish(*sample);
    intake_.push(std::move(*sample));
    constexpr Stamp kSlice = kNanosecondsPerSecond / 10;
    while (as_fast_as_possible_ && !stop_ && !inbox_.wait_for_room(kSlice)) {
    }
  }
  intake_.close();
}

void OwnSensors::publish(const Sample& sample) {
  if (const auto* frame = std::get_if<ImageSample>(&sample)) frames_.publish(*frame);
  if (const auto* imu = std::get_if<ImuSample>(&sample)) imu_.publish(*imu);
  if (const auto* odometry = std::get_if<WheelOdometrySample>(&sample)) odometry_.publish(*odometry);
  if (const auto* pose = std::get_if<WearerPoseSample>(&sample); pose && poses_) poses_->publish(*pose);
  if (const auto* scan = std::get_if<LaserScanSample>(&sample)) {
    (scan->laser == transport::frames::kLaserFront ? front_scans_ : rear_scans_).publish(*scan);
  }
}

void OwnSensors::report(outbox::YamlText& text) const {
  const SourceCounters counters = source_->counters();
  text.section("own_sensors")
      .value("delivered", counters.delivered)
      .value("unreadable", counters.unreadable)
      .value("wrong_size", counters.wrong_size)
      .value("not_finite", counters.not_finite)
      .value("stamp_went_back", counters.stamp_went_back)
      .value("gaps", counters.gaps);
  outbox::report(text, "dds_robot_image_compressed", frames_.counters());
  outbox::report(text, "dds_robot_laser_front", front_scans_.counters());
  outbox::report(text, "dds_robot_laser_rear", rear_scans_.counters());
  outbox::report(text, "dds_robot_imu", imu_.counters());
  outbox::report(text, "dds_robot_wheel_odometry", odometry_.counters());
}

}  // namespace cosight::robot
