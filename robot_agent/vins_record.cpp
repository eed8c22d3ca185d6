#include "robot_agent/vins_record.hpp"

#include "robot_agent/outbox/frame_log.hpp"

namespace cosight::robot {

using vins::VinsStatus;

std::string spoken(const vins::VinsEstimate& estimate) {
  switch (estimate.status) {
    case VinsStatus::kInitialising:
      return std::string("not yet observable: ") + to_string(estimate.initialisation);
    case VinsStatus::kFailed:
      return std::string("failed: ") + to_string(estimate.failure);
    case VinsStatus::kWaitingForImu:
    case VinsStatus::kTracking:
      break;
  }
  return to_string(estimate.status);
}

VinsRecord::VinsRecord(const std::filesystem::path& folder) : trajectory_(folder / "vins.tum") {
  trajectory_.append("# T_WS: t[s] px py pz[m] qx qy qz qw; W: z up, where VINS started");
}

void VinsRecord::add(const vins::VinsEstimate& estimate, const std::optional<Pose>& T_WS) {
  if (!first_stamp_) first_stamp_ = estimate.stamp;
  last_state_ = spoken(estimate);
  if (estimate.status == VinsStatus::kInitialising)
    ++not_yet_.at(static_cast<std::size_t>(estimate.initialisation));
  if (estimate.status == VinsStatus::kFailed) ++failures_.at(static_cast<std::size_t>(estimate.failure));
  if (estimate.report) {
    solve_ms_.add(estimate.report->solve_ms);
    marginalise_ms_.add(estimate.report->marginalise_ms);
  }
  const bool starts = T_WS && !last_p_WS_;
  if (starts && starts_ > 0) trajectory_.append("# started anew: another W");
  starts_ += starts ? 1 : 0;
  if (!T_WS) {
    last_p_WS_.reset();
    return;
  }
  ++tracking_;
  if (!first_tracking_) first_tracking_ = estimate.stamp;
  if (last_p_WS_) path_m_ += (T_WS->p - *last_p_WS_).norm();
  last_p_WS_ = T_WS->p;
  trajectory_.append(outbox::trajectory_line(estimate.stamp, *T_WS));
}

std::optional<std::string> VinsRecord::close() {
  trajectory_.close();
  return trajectory_.loss();
}

void VinsRecord::report(outbox::YamlText& text, const vins::VinsCounters& counters) const {
  text.section("vins")
      .value("state", last_state_)
      .value("frames_tracking", tracking_)
      .value("starts", starts_);
  if (first_tracking_) text.value("first_start_s", to_seconds(*first_tracking_ - *first_stamp_));
  text.value("path_m", path_m_)
      .value("images", counters.images)
      .value("images_dropped", counters.images_dropped)
      .value("images_undecodable", counters.images_undecodable)
      .value("images_out_of_order", counters.images_out_of_order)
      .value("images_without_imu", counters.images_without_imu)
      .value("imu_samples", counters.imu_samples)
      .value("imu_refused", counters.imu_refused)
      .value("sightings", counters.sightings)
      .value("outlier_sightings", counters.outlier_sightings)
      .value("distances", counters.distances)
      .value("distances_given", counters.distances_given)
      .value("solve_ms_median", solve_ms_.quantile(0.5))
      .value("solve_ms_p99", solve_ms_.quantile(0.99))
      .value("marginalise_ms_median", marginalise_ms_.quantile(0.5));
  text.section("vins_not_yet_observable");
  for (std::size_t i = 1; i < kReasons; ++i) {
    text.value(to_string(static_cast<vins::InitialisationOutcome>(i)), not_yet_.at(i));
  }
  text.section("vins_failures");
  for (std::size_t i = 1; i < kFailures; ++i) {
    text.value(to_string(static_cast<vins::Failure>(i)), failures_.at(i));
  }
  text.top();
}

}  // namespace cosight::robot
