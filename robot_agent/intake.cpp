#include "robot_agent/intake.hpp"

#include <spdlog/spdlog.h>

#include <utility>

#include "robot_agent/outbox/publisher.hpp"

namespace cosight::robot {

Intake::Intake(inbox::Inbox& inbox, const transport::Participant& participant,
               const std::optional<LocatorPlan>& plan)
    : Intake(inbox, plan) {
  if (plan) located_.emplace(participant, transport::topics::kRobotWearerPose);
}

Intake::Intake(inbox::Inbox& inbox, const std::optional<LocatorPlan>& plan)
    : inbox_(inbox), takes_tracked_(!plan || plan->yields) {
  if (!plan) return;
  locator_.emplace(plan->options, plan->yaw_WA,
                   [this](Stamp stamp, const auto& pose) { take_located(stamp, pose); });
}

void Intake::feed(VinsBackEnd& vins, Estimators estimators) {
  vins_ = &vins;
  feeds_slam_ = has_slam(estimators);
}

void Intake::push(Sample sample) {
  if (vins_ != nullptr) feed_vins(sample);
  if (auto* const scan = std::get_if<LaserScanSample>(&sample)) {
    if (locator_) locator_->add(std::move(*scan));
  } else if (const auto* const odometry = std::get_if<WheelOdometrySample>(&sample)) {
    if (locator_) locator_->add(*odometry);
  } else if (const auto* const pose = std::get_if<WearerPoseSample>(&sample)) {
    if (takes_tracked_) take_tracked(*pose);
  } else if (feeds_slam_) {
    inbox_.push(std::move(sample));
  }
}

void Intake::push_ahrs(AhrsSample sample, const inbox::PeerId& peer) {
  if (!inbox_.push_ahrs(sample, peer) || !locator_) return;
  sample.stamp = inbox_.stamps().from_wearer(sample.stamp);
  locator_->add(sample);
}

void Intake::robot_is_at(const FrameEstimate& estimate) {
  if (locator_) locator_->add(estimate);
}

void Intake::close() {
  if (locator_) locator_->finish();
  inbox_.close();
}

void Intake::report(outbox::YamlText& text) const {
  if (!locator_) return;
  const wearer::WearerCounters counters = locator_->counters();
  text.section("wearer_by_laser")
      .value("scans", counters.scans)
      .value("scans_refused", counters.scans_refused)
      .value("scans_late", counters.scans_late)
      .value("scans_without_odometry", counters.scans_without_odometry)
      .value("ahrs_refused", counters.ahrs_refused)
      .value("estimates_late", locator_->estimates_late())
      .value("seen", counters.seen)
      .value("predicted", counters.predicted)
      .value("losses", counters.losses);
  if (located_) outbox::report(text, "dds_wearer_by_laser", located_->counters());
}

void Intake::feed_vins(const Sample& sample) {
  if (const auto* const imu = std::get_if<ImuSample>(&sample)) vins_->push(*imu);
  if (const auto* const frame = std::get_if<ImageSample>(&sample)) vins_->push(*frame);
}

void Intake::take_tracked(const WearerPoseSample& pose) {
  if (locator_ && !tracker_speaks_.exchange(true)) {
    spdlog::info("a tracker says where the wearer is: the lasers are not used for it");
  }
  inbox_.push_wearer_pose(pose);
}

void Intake::take_located(Stamp stamp, const std::optional<WearerPoseSample>& pose) {
  if (tracker_speaks_) return;
  if (!pose) {
    inbox_.push_no_wearer_pose(stamp);
    return;
  }
  if (located_) located_->publish(*pose);
  inbox_.push_wearer_pose(*pose);
}

}  // namespace cosight::robot
