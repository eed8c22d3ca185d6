#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace cosight::recording {

/// ROS 2's name of a DDS topic, "rt/cosight/robot/imu" as "/cosight/robot/imu"; any other stays as it is.
std::string ros_topic(std::string_view dds_topic);
std::string dds_topic(std::string_view ros_topic);

/// "sensor_msgs/msg/Imu" for "sensor_msgs::msg::dds_::Imu_", "pkg/Type" for "pkg::Type".
std::string ros_type(std::string_view dds_type);
std::string dds_type(std::string_view ros_type);

/// Whether `text` is as `pattern` says: * stands for any characters, ? for one.
bool matches(std::string_view text, std::string_view pattern);

}  // namespace cosight::recording
