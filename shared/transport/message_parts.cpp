#include "shared/transport/message_parts.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>

namespace cosight::transport {

Fault to_header(Stamp stamp, std::string_view frame_id, std_msgs::msg::Header& header) {
  Stamp seconds = stamp / kNanosecondsPerSecond;
  Stamp nanoseconds = stamp % kNanosecondsPerSecond;
  if (nanoseconds < 0) {  // ROS: the nanoseconds always count forward
    nanoseconds += kNanosecondsPerSecond;
    --seconds;
  }
  using Seconds = std::numeric_limits<std::int32_t>;
  if (seconds < Seconds::min() || seconds > Seconds::max()) return Fault::kStamp;
  header.stamp().sec(static_cast<std::int32_t>(seconds));
  header.stamp().nanosec(static_cast<std::uint32_t>(nanoseconds));
  header.frame_id(std::string(frame_id));
  return Fault::kNone;
}

Fault from_header(const std_msgs::msg::Header& header, Stamp& stamp) {
  if (header.stamp().nanosec() >= kNanosecondsPerSecond) return Fault::kStamp;
  stamp = Stamp{header.stamp().sec()} * kNanosecondsPerSecond + Stamp{header.stamp().nanosec()};
  return header.frame_id().size() > kLongestText ? Fault::kText : Fault::kNone;
}

geometry_msgs::msg::Quaternion to_message(const Eigen::Quaterniond& q) {
  geometry_msgs::msg::Quaternion message;
  message.x(q.x());
  message.y(q.y());
  message.z(q.z());
  message.w(q.w());
  return message;
}

Eigen::Quaterniond from_message(const geometry_msgs::msg::Quaternion& q) {
  return {q.w(), q.x(), q.y(), q.z()};
}

geometry_msgs::msg::Vector3 to_message(const Eigen::Vector3d& v) {
  geometry_msgs::msg::Vector3 message;
  message.x(v.x());
  message.y(v.y());
  message.z(v.z());
  return message;
}

Eigen::Vector3d from_message(const geometry_msgs::msg::Vector3& v) {
  return {v.x(), v.y(), v.z()};
}

geometry_msgs::msg::PoseWithCovariance to_message(const UncertainPose& pose) {
  geometry_msgs::msg::PoseWithCovariance message;
  message.pose().position().x(pose.T.p.x());
  message.pose().position().y(pose.T.p.y());
  message.pose().position().z(pose.T.p.z());
  message.pose().orientation(to_message(pose.T.q));
  message.covariance(to_rows<6>(pose.covariance));
  return message;
}

UncertainPose from_message(const geometry_msgs::msg::PoseWithCovariance& pose) {
  const geometry_msgs::msg::Point& p = pose.pose().position();
  return {{from_message(pose.pose().orientation()), {p.x(), p.y(), p.z()}}, from_rows<6>(pose.covariance())};
}

Fault check_finite(const Eigen::Vector3d& v) {
  return v.allFinite() ? Fault::kNone : Fault::kNotFinite;
}

Fault check_rotation(const Eigen::Quaterniond& q) {
  if (!q.coeffs().allFinite()) return Fault::kNotFinite;
  return std::abs(q.norm() - 1.0) > 1e-3 ? Fault::kRotation : Fault::kNone;
}

Fault check_text(std::string_view text) {
  const bool printable = std::all_of(text.begin(), text.end(), [](char c) { return c >= ' ' && c <= '~'; });
  return text.size() > kLongestText || !printable ? Fault::kText : Fault::kNone;
}

}  // namespace cosight::transport
