#include <nav_msgs.h>
#include <sensor_msgs.h>

#include <algorithm>
#include <cmath>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

// A turn of a laser with 0.05 degrees between its rays has 7,200.
constexpr std::size_t kMostRanges = 10'000;

/// Of everything but the ranges: those may be what they like, not finite says that nothing came back.
Fault check(const LaserScanSample& scan) {
  const auto values = {scan.angle_min, scan.angle_increment, scan.range_min, scan.range_max};
  if (!std::all_of(values.begin(), values.end(), [](float v) { return std::isfinite(v); })) {
    return Fault::kNotFinite;
  }
  return scan.ranges.size() > kMostRanges ? Fault::kDimensions : Fault::kNone;
}

Fault check(const ImuSample& sample) {
  return first_of(check_finite(sample.angular_velocity_I), check_finite(sample.acceleration_I));
}

Fault check(const WheelOdometrySample& sample) {
  const auto values = {sample.x, sample.y, sample.yaw, sample.speed, sample.turn_rate};
  const bool finite = std::all_of(values.begin(), values.end(), [](double v) { return std::isfinite(v); });
  return finite ? Fault::kNone : Fault::kNotFinite;
}

/// About z, of the rotation that turns x the same way in the plane.
double yaw_of(const Eigen::Quaterniond& q) {
  return std::atan2(2.0 * (q.w() * q.z() + q.x() * q.y()), 1.0 - 2.0 * (q.y() * q.y() + q.z() * q.z()));
}

}  // namespace

Fault encode(const LaserScanSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  sensor_msgs::msg::LaserScan message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.angle_min(sample.angle_min);
  message.angle_increment(sample.angle_increment);
  const std::size_t last = std::max<std::size_t>(sample.ranges.size(), 1) - 1;
  message.angle_max(sample.angle_min + sample.angle_increment * static_cast<float>(last));
  message.range_min(sample.range_min);
  message.range_max(sample.range_max);
  message.ranges(sample.ranges);
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, LaserScanSample& sample) {
  sensor_msgs::msg::LaserScan message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  sample.laser = topic.frame_id;  // the topic says which one it is, whatever the driver calls its frame
  sample.angle_min = message.angle_min();
  sample.angle_increment = message.angle_increment();
  sample.range_min = message.range_min();
  sample.range_max = message.range_max();
  sample.ranges = std::move(message.ranges());
  return check(sample);
}

Fault encode(const ImuSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  sensor_msgs::msg::Imu message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.orientation(to_message(Eigen::Quaterniond::Identity()));
  message.orientation_covariance()[0] = kUnknown;
  message.angular_velocity(to_message(sample.angular_velocity_I));
  message.linear_acceleration(to_message(sample.acceleration_I));
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, ImuSample& sample) {
  sensor_msgs::msg::Imu message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  sample.angular_velocity_I = from_message(message.angular_velocity());
  sample.acceleration_I = from_message(message.linear_acceleration());
  return check(sample);
}

Fault encode(const WheelOdometrySample& sample, const TopicProfile& topic,
             std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  nav_msgs::msg::Odometry message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.child_frame_id(std::string(frames::kRobotBody));
  message.pose().pose().position().x(sample.x);
  message.pose().pose().position().y(sample.y);
  message.pose().pose().orientation(
      to_message(Eigen::Quaterniond(Eigen::AngleAxisd(sample.yaw, Eigen::Vector3d::UnitZ()))));
  message.twist().twist().linear().x(sample.speed);
  message.twist().twist().angular().z(sample.turn_rate);
  return serialize(message, topic.max_bytes, payload);  // the covariances stay zero: unknown
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, WheelOdometrySample& sample) {
  nav_msgs::msg::Odometry message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.child_frame_id().size() > kLongestText) return Fault::kText;
  const Eigen::Quaterniond q_OB = from_message(message.pose().pose().orientation());
  if (const Fault fault = check_rotation(q_OB); fault != Fault::kNone) return fault;
  sample.x = message.pose().pose().position().x();
  sample.y = message.pose().pose().position().y();
  sample.yaw = yaw_of(q_OB.normalized());
  sample.speed = message.twist().twist().linear().x();
  sample.turn_rate = message.twist().twist().angular().z();
  return check(sample);
}

}  // namespace cosight::transport
