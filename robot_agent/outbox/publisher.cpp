#include "robot_agent/outbox/publisher.hpp"

#include "robot_agent/outbox/conversions.hpp"

namespace cosight::outbox {

bool Throttle::due(Stamp stamp) {
  if (last_ && stamp >= *last_ && stamp - *last_ < interval_) return false;
  last_ = stamp;
  return true;
}

EstimatePublisher::EstimatePublisher(const transport::Participant& participant, Stamp map_interval)
    : odometry_(participant, transport::topics::kRobotOdometry),
      overlap_(participant, transport::topics::kRobotOverlap),
      diagnostics_(participant, transport::topics::kRobotDiagnostics),
      map_(participant, transport::topics::kRobotMap),
      map_throttle_(map_interval) {}

void EstimatePublisher::publish(const FrameEstimate& estimate, const MapSource& map) {
  if (estimate.tracking != Tracking::kWaitingForScale) odometry_.publish(odometry_of(estimate));
  overlap_.publish(overlap_of(estimate));
  const bool changed = last_tracking_ != estimate.tracking;
  last_tracking_ = estimate.tracking;
  if (diagnostics_throttle_.due(estimate.stamp) || changed) diagnostics_.publish(diagnostic_of(estimate));
  if (map && map_throttle_.due(estimate.stamp)) map_.publish(cloud_of(estimate.stamp, map()));
}

void EstimatePublisher::finish(std::chrono::milliseconds timeout) {
  odometry_.wait_until_delivered(timeout);
  overlap_.wait_until_delivered(timeout);
  diagnostics_.wait_until_delivered(timeout);
  map_.wait_until_delivered(timeout);
}

void EstimatePublisher::report(YamlText& text) const {
  outbox::report(text, "dds_odometry", odometry_.counters());
  outbox::report(text, "dds_overlap", overlap_.counters());
  outbox::report(text, "dds_diagnostics", diagnostics_.counters());
  outbox::report(text, "dds_map", map_.counters());
}

void report(YamlText& text, std::string_view section, const transport::PublisherCounters& counters) {
  text.section(section)
      .value("sent", counters.sent)
      .value("bytes", counters.bytes)
      .value("refused", counters.refused)
      .value("failed", counters.failed)
      .value("stalled", counters.stalled)
      .value("matched", counters.matched)
      .value("unmatched", counters.unmatched)
      .value("incompatible_qos", counters.incompatible_qos)
      .top();
}

void report(YamlText& text, std::string_view section, const transport::SubscriberCounters& counters) {
  text.section(section)
      .value("received", counters.received)
      .value("bytes", counters.bytes)
      .value("lost", counters.lost)
      .value("invalid", counters.invalid)
      .value("matched", counters.matched)
      .value("unmatched", counters.unmatched)
      .value("liveliness_lost", counters.liveliness_lost)
      .value("incompatible_qos", counters.incompatible_qos)
      .top();
}

}  // namespace cosight::outbox
