#pragma once

#include <algorithm>
#include <string>
#include <vector>

#include "shared/recording/type_names.hpp"

namespace cosight::recording {

/// Which topics are wanted, by wildcards on ROS 2's or DDS's names.
struct TopicSelection {
  std::vector<std::string> allow;  ///< empty: all
  std::vector<std::string> deny;   ///< stronger than allow

  bool wants(const std::string& dds_name) const {
    const std::string ros_name = ros_topic(dds_name);
    const auto is_one_of = [&](const std::vector<std::string>& patterns) {
      return std::any_of(patterns.begin(), patterns.end(), [&](const std::string& pattern) {
        return matches(ros_name, pattern) || matches(dds_name, pattern);
      });
    };
    return (allow.empty() || is_one_of(allow)) && !is_one_of(deny);
  }
};

}  // namespace cosight::recording
