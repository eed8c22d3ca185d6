#pragma once

#include <filesystem>
#include <map>
#include <optional>
#include <string>

#include "shared/recording/message_definition.hpp"

namespace cosight::recording {

/// The definitions of message types, so that a recording explains itself.
class MessageSchemas {
 public:
  /// Those of Cosight's own wire.
  static MessageSchemas built_in();

  /// Every .msg and .idl file below the folder: a .msg file's package is the folder above "msg", or the one
  /// it lies in. What is known already stays. Throws RecordingError when there is no such folder.
  void add_folder(const std::filesystem::path& folder);
  void add(MessageDefinition definition);

  /// The text of MCAP's "ros2msg" for "sensor_msgs/msg/Imu": the message and all that it consists of. Nothing
  /// when one of them is not known.
  std::optional<std::string> ros2msg(const std::string& type) const;

 private:
  std::map<std::string, MessageDefinition> definitions_;
};

}  // namespace cosight::recording
