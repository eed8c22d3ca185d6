#include <geometry_msgs.h>
#include <nav_msgs.h>
#include <sensor_msgs.h>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

Fault check(const AhrsSample& sample) {
  return first_of(check_rotation(sample.q_WH), check_covariance<3>(sample.orientation_covariance),
                  check_finite(sample.angular_velocity_H), check_finite(sample.acceleration_H));
}

Fault check(const UncertainPose& pose) {
  return first_of(check_rotation(pose.T.q), check_finite(pose.T.p), check_covariance<6>(pose.covariance));
}

Fault check(const OdometrySample& sample) {
  return first_of(check(sample.T_WS), check_finite(sample.v_S), check_finite(sample.omega_S),
                  check_covariance<6>(sample.twist_covariance));
}

/// Position only: the orientation is the identity, and its covariance zero.
UncertainPose without_orientation(const UncertainPose& pose) {
  UncertainPose position;
  position.T.p = pose.T.p;
  position.covariance.topLeftCorner<3, 3>() = pose.covariance.topLeftCorner<3, 3>();
  return position;
}

}  // namespace

Fault encode(const AhrsSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  sensor_msgs::msg::Imu message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.orientation(to_message(sample.q_WH));
  message.orientation_covariance(to_rows<3>(sample.orientation_covariance));
  message.angular_velocity(to_message(sample.angular_velocity_H));
  message.linear_acceleration(to_message(sample.acceleration_H));
  return serialize(message, topic.max_bytes, payload);  // the other covariances stay zero: unknown
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, AhrsSample& sample) {
  sensor_msgs::msg::Imu message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.orientation_covariance()[0] == kUnknown) return Fault::kRotation;
  sample.q_WH = from_message(message.orientation());
  sample.orientation_covariance = from_rows<3>(message.orientation_covariance());
  sample.angular_velocity_H = from_message(message.angular_velocity());
  sample.acceleration_H = from_message(message.linear_acceleration());
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  sample.q_WH.normalize();
  return Fault::kNone;
}

Fault encode(const WearerPoseSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  UncertainPose T_SF = sample.has_orientation ? sample.T_SF : without_orientation(sample.T_SF);
  if (const Fault fault = check(T_SF); fault != Fault::kNone) return fault;
  if (!sample.has_orientation) T_SF.covariance.diagonal().tail<3>().setConstant(kUnknown);
  geometry_msgs::msg::PoseWithCovarianceStamped message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.pose(to_message(T_SF));
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, WearerPoseSample& sample) {
  geometry_msgs::msg::PoseWithCovarianceStamped message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  sample.T_SF = from_message(message.pose());
  sample.has_orientation = sample.T_SF.covariance.diagonal().tail<3>().minCoeff() >= 0.0;
  if (!sample.T_SF.covariance.allFinite()) return Fault::kNotFinite;
  if (!sample.has_orientation) sample.T_SF = without_orientation(sample.T_SF);
  if (const Fault fault = check(sample.T_SF); fault != Fault::kNone) return fault;
  sample.T_SF.T.q.normalize();
  return Fault::kNone;
}

Fault encode(const OdometrySample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  nav_msgs::msg::Odometry message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.child_frame_id(std::string(frames::kRobotCamera));
  message.pose(to_message(sample.T_WS));
  message.twist().twist().linear(to_message(sample.v_S));
  message.twist().twist().angular(to_message(sample.omega_S));
  message.twist().covariance(to_rows<6>(sample.twist_covariance));
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, OdometrySample& sample) {
  nav_msgs::msg::Odometry message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.child_frame_id().size() > kLongestText) return Fault::kText;
  sample.T_WS = from_message(message.pose());
  sample.v_S = from_message(message.twist().twist().linear());
  sample.omega_S = from_message(message.twist().twist().angular());
  sample.twist_covariance = from_rows<6>(message.twist().covariance());
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  sample.T_WS.T.q.normalize();
  return Fault::kNone;
}

}  // namespace cosight::transport
