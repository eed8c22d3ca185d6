#include "robot_agent/wearer_link.hpp"

#include <thread>

#include "robot_agent/outbox/publisher.hpp"

namespace cosight::robot {
namespace {

using transport::Reception;

auto push_frame(inbox::Inbox& inbox) {
  return [&inbox](ImageSample&& frame, const Reception& reception) {
    inbox.push_wearer_frame(std::move(frame), inbox::peer_of(reception.writer_id));
  };
}

}  // namespace

WearerLink::WearerLink(const transport::Participant& participant, inbox::Inbox& inbox, Intake& intake,
                       bool track_poses)
    : compressed_(participant, transport::topics::kWearableImageCompressed, push_frame(inbox)),
      raw_(participant, transport::topics::kWearableImage, push_frame(inbox)),
      calibration_(participant, transport::topics::kWearableCameraInfo,
                   [this, &inbox](CameraInfoSample&& sample, const Reception&) {
                     inbox.set_wearer_camera(sample.camera);
                     has_calibration_ = true;
                   }),
      ahrs_(participant, transport::topics::kWearableImu,
            [&intake](AhrsSample&& sample, const Reception& reception) {
              intake.push_ahrs(std::move(sample), inbox::peer_of(reception.writer_id));
            }),
      heartbeat_(
          participant, transport::topics::kWearableHeartbeat,
          [&inbox](HeartbeatSample&&, const Reception& reception) {
            inbox.push_wearer_heartbeat(inbox::peer_of(reception.writer_id));
          },
          [&inbox](const transport::WriterId& writer) { inbox.wearer_gone(inbox::peer_of(writer)); }) {
  if (!track_poses) return;
  poses_.emplace(participant, transport::topics::kRobotWearerPose,
                 [&intake](WearerPoseSample&& sample, const Reception& reception) {
                   if (!reception.from_own_process) intake.push(std::move(sample));
                 });
}

bool WearerLink::wait_for_wearer(std::chrono::milliseconds timeout, const std::atomic<bool>& stop) const {
  constexpr std::chrono::milliseconds kSlice{5};
  for (auto waited = kSlice; !has_calibration_ && !stop && waited <= timeout; waited += kSlice) {
    std::this_thread::sleep_for(kSlice);
  }
  return has_calibration_;
}

std::uint64_t WearerLink::frames_lost() const {
  return compressed_.counters().lost + raw_.counters().lost;
}

void WearerLink::report(outbox::YamlText& text) const {
  outbox::report(text, "dds_wearer_image_compressed", compressed_.counters());
  outbox::report(text, "dds_wearer_image", raw_.counters());
  outbox::report(text, "dds_wearer_imu", ahrs_.counters());
  outbox::report(text, "dds_wearer_heartbeat", heartbeat_.counters());
  if (poses_) outbox::report(text, "dds_wearer_pose", poses_->counters());
}

}  // namespace cosight::robot
