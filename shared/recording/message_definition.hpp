#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace cosight::recording {

/// One message as a .msg file says it, and the messages that its fields are of.
struct MessageDefinition {
  std::string name;  ///< "sensor_msgs/msg/Imu"
  std::string text;
  std::vector<std::string> fields_of;  ///< names like its own
};

/// A .msg file of the package.
MessageDefinition parse_msg(const std::string& package, const std::string& name, const std::string& text);

/// The structs of an .idl file, translated. What ROS 2 can't say (unions, maps, sequences of sequences) and
/// what follows a mistake is left out.
std::vector<MessageDefinition> parse_idl(std::string_view text);

}  // namespace cosight::recording
