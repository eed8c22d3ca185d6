#include "robot_agent/vins_back_end.hpp"

#include "robot_agent/inbox/frame_decoder.hpp"
#include "robot_agent/outbox/publisher.hpp"
#include "robot_agent/vins/uncertainty.hpp"
#include "robot_agent/vins_distances.hpp"
#include "robot_agent/vins_odometry.hpp"

namespace cosight::robot {
namespace {

vins::UncertainNavState newest_state(const vins::Window& window, const vins::GraphOptions& graph) {
  const vins::WindowFrame& newest = window.frames.back();
  return {newest.stamp, newest.state, vins::state_covariance(window, graph, newest.id)};
}

}  // namespace

VinsBackEnd::VinsBackEnd(const vins::VinsThreadOptions& options, const CameraModel& camera, const Pose& T_BS,
                         const std::filesystem::path& run_folder, const transport::Participant* participant,
                         const VinsHelp& help)
    : camera_(camera),
      options_(options),
      record_(run_folder),
      takes_depths_(help.takes_depths),
      thread_(options, camera, T_BS,
              [this](const auto& estimate, const auto& window) { take(estimate, window); }) {
  if (help.guides_slam) guide_.emplace(options.vins.noise, T_BS, options.vins.window.solver.graph.gravity);
  if (participant != nullptr) publisher_.emplace(*participant, transport::topics::kRobotVinsOdometry);
}

void VinsBackEnd::push(const ImuSample& sample) {
  // The IMU's axes are those of the body that the camera's calibration speaks of.
  const vins::ImuSample imu{sample.stamp, sample.acceleration_I, sample.angular_velocity_I};
  if (guide_) guide_->add_imu(imu);
  thread_.push_imu(imu);
}

void VinsBackEnd::push(const ImageSample& frame) {
  if (takes_depths_) return;
  thread_.push_image(frame.stamp, [this, frame] {
    return inbox::decode_frame(frame, {camera_.width, camera_.height}).image;
  });
}

void VinsBackEnd::push(const FrameBundle& bundle, const FrameEstimate& estimate) {
  if (!takes_depths_) return;
  thread_.push_image(
      bundle.stamp, [image = bundle.image] { return image; }, distances_of(estimate.stereo_depths, camera_));
}

void VinsBackEnd::guide(FrameBundle& bundle) {
  if (!guide_) return;
  if (last_bundle_) {
    thread_.wait_for(*last_bundle_);
    bundle.twist = guide_->twist(*last_bundle_, bundle.stamp);
    frames_guided_ += bundle.twist ? 1 : 0;
  }
  last_bundle_ = bundle.stamp;
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
  if (guide_) text.section("vins_guide").value("frames", frames_guided_).top();
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
  std::optional<vins::UncertainNavState> state;
  if (T_WS && (publisher_ || guide_)) state = newest_state(window, options_.vins.window.solver.graph);
  if (state && publisher_) publisher_->publish(odometry_of(window, *state, options_.vins.noise));
  if (guide_) guide_->add(estimate.stamp, state);
  const std::lock_guard lock(mutex_);
  state_ = spoken(estimate);
}

}  // namespace cosight::robot
