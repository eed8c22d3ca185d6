#include "robot_agent/vins_back_end.hpp"

#include "robot_agent/inbox/frame_decoder.hpp"
#include "robot_agent/outbox/publisher.hpp"
#include "robot_agent/vins_odometry.hpp"

namespace cosight::robot {

VinsBackEnd::VinsBackEnd(const vins::VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS,
                         const std::filesystem::path& run_folder, const transport::Participant* participant)
    : camera_(camera),
      options_(options),
      record_(run_folder),
      thread_(options, camera, T_BS,
              [this](const auto& estimate, const auto& window) { take(estimate, window); }) {
  if (participant != nullptr) publisher_.emplace(*participant, transport::topics::kRobotVinsOdometry);
}

void VinsBackEnd::push(const ImuSample& sample) {
  // The IMU's axes are those of the body that the camera's calibration speaks of.
  thread_.push_imu({sample.stamp, sample.acceleration_I, sample.angular_velocity_I});
}

void VinsBackEnd::push(const ImageSample& frame) {
  thread_.push_image(frame.stamp, [this, frame] {
    return inbox::decode_frame(frame, {camera_.width, camera_.height}).image;
  });
}

void VinsBackEnd::finish() {
  thread_.finish();
}

std::string VinsBackEnd::status() const {
  const std::lock_guard lock(mutex_);
  return "vins " + state_;
}

void VinsBackEnd::report(outbox::YamlText& text) const {
  record_.report(text, thread_.counters());
  if (publisher_) outbox::report(text, "dds_vins_odometry", publisher_->counters());
}

std::vector<std::string> VinsBackEnd::problems() {
  std::vector<std::string> problems;
  if (const auto lost = record_.close()) problems.push_back(*lost);
  const vins::VinsCounters counters = thread_.counters();
  if (counters.imu_samples == 0) problems.emplace_back("vins had no sample of the robot's IMU");
  if (counters.images_dropped > 0) {
    problems.push_back(std::to_string(counters.images_dropped) +
                       " robot images came faster than vins could process them");
  }
  return problems;
}

void VinsBackEnd::take(const vins::VinsEstimate& estimate, const vins::Window& window) {
  std::optional<Pose> T_WS;
  if (estimate.status == vins::VinsStatus::kTracking) T_WS = estimate.report->state.T_WB * window.T_BS;
  record_.add(estimate, T_WS);
  if (T_WS && publisher_) {
    publisher_->publish(odometry_of(window, options_.vins.window.solver.graph, options_.vins.noise));
  }
  const std::lock_guard lock(mutex_);
  state_ = spoken(estimate);
}

}  // namespace cosight::robot
