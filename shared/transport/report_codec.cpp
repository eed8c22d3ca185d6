#include <cosight_msgs.h>

#include <cmath>
#include <cstdint>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

using WirePolygon = std::vector<cosight_msgs::msg::Pixel>;
using Polygon = std::vector<Eigen::Vector2d>;

// Two rectangles cut in at most eight corners; rounded lenses may add some.
constexpr std::size_t kMostCorners = 256;

WirePolygon to_message(const Polygon& polygon) {
  WirePolygon message(polygon.size());
  for (std::size_t i = 0; i < polygon.size(); ++i) {
    message[i].u(polygon[i].x());
    message[i].v(polygon[i].y());
  }
  return message;
}

Polygon from_message(const WirePolygon& message) {
  Polygon polygon;
  polygon.reserve(message.size());
  for (const cosight_msgs::msg::Pixel& corner : message)
    polygon.emplace_back(corner.u(), corner.v());
  return polygon;
}

Fault check(const Polygon& polygon) {
  if (polygon.size() > kMostCorners) return Fault::kDimensions;
  for (const Eigen::Vector2d& corner : polygon) {
    if (!corner.allFinite()) return Fault::kNotFinite;
  }
  return Fault::kNone;
}

Fault check(const OverlapSample& sample) {
  return first_of(std::isfinite(sample.far_depth) ? Fault::kNone : Fault::kNotFinite, check(sample.roi_in_S),
                  check(sample.roi_in_F), check_text(sample.outcome));
}

cosight_msgs::msg::SourceStatus to_message(const SourceCounters& counters) {
  cosight_msgs::msg::SourceStatus message;
  message.delivered(counters.delivered);
  message.unreadable(counters.unreadable);
  message.wrong_size(counters.wrong_size);
  message.not_finite(counters.not_finite);
  message.stamp_went_back(counters.stamp_went_back);
  message.gaps(counters.gaps);
  return message;
}

SourceCounters from_message(const cosight_msgs::msg::SourceStatus& message) {
  SourceCounters counters;
  counters.delivered = message.delivered();
  counters.unreadable = message.unreadable();
  counters.wrong_size = message.wrong_size();
  counters.not_finite = message.not_finite();
  counters.stamp_went_back = message.stamp_went_back();
  counters.gaps = message.gaps();
  return counters;
}

}  // namespace

Fault encode(const OverlapSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  cosight_msgs::msg::OverlapReport message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.predicted(sample.predicted);
  message.far_depth(sample.far_depth);
  message.roi_in_robot_image(to_message(sample.roi_in_S));
  message.roi_in_wearer_image(to_message(sample.roi_in_F));
  message.described(sample.described);
  message.ratio_test(sample.ratio_test);
  message.epipolar(sample.epipolar);
  message.too_little_parallax(sample.too_little_parallax);
  message.chi_squared(sample.chi_squared);
  message.joint_compatibility(sample.joint_compatibility);
  message.fused(sample.fused);
  message.initialised(sample.initialised);
  message.redundant(sample.redundant);
  message.outcome(sample.outcome);
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, OverlapSample& sample) {
  cosight_msgs::msg::OverlapReport message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  sample.predicted = message.predicted();
  sample.far_depth = message.far_depth();
  sample.roi_in_S = from_message(message.roi_in_robot_image());
  sample.roi_in_F = from_message(message.roi_in_wearer_image());
  sample.described = message.described();
  sample.ratio_test = message.ratio_test();
  sample.epipolar = message.epipolar();
  sample.too_little_parallax = message.too_little_parallax();
  sample.chi_squared = message.chi_squared();
  sample.joint_compatibility = message.joint_compatibility();
  sample.fused = message.fused();
  sample.initialised = message.initialised();
  sample.redundant = message.redundant();
  sample.outcome = message.outcome();
  return check(sample);
}

Fault encode(const HeartbeatSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check_text(sample.agent_id); fault != Fault::kNone) return fault;
  cosight_msgs::msg::Heartbeat message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.agent_id(sample.agent_id);
  message.instance_id(sample.instance_id);
  message.beat(sample.beat);
  message.frames_sent(sample.frames_sent);
  message.orientations_sent(sample.orientations_sent);
  message.frames(to_message(sample.frames));
  message.orientations(to_message(sample.orientations));
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, HeartbeatSample& sample) {
  cosight_msgs::msg::Heartbeat message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  sample.agent_id = message.agent_id();
  sample.instance_id = message.instance_id();
  sample.beat = message.beat();
  sample.frames_sent = message.frames_sent();
  sample.orientations_sent = message.orientations_sent();
  sample.frames = from_message(message.frames());
  sample.orientations = from_message(message.orientations());
  return check_text(sample.agent_id);
}

}  // namespace cosight::transport
