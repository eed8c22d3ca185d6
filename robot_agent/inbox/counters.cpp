#include "robot_agent/inbox/counters.hpp"

namespace cosight::inbox {

std::vector<std::pair<std::string_view, std::uint64_t>> named_counts(const InboxCounters& counters) {
  return {
      {"robot_frames", counters.robot_frames},
      {"robot_lost", counters.robot_lost},
      {"robot_out_of_order", counters.robot_out_of_order},
      {"robot_images_dropped", counters.robot_images_dropped},
      {"robot_frames_dropped", counters.robot_frames_dropped},
      {"robot_undecodable", counters.robot_undecodable},
      {"robot_wrong_size", counters.robot_wrong_size},
      {"worn_frames", counters.worn_frames},
      {"worn_lost", counters.worn_lost},
      {"worn_out_of_order", counters.worn_out_of_order},
      {"worn_late", counters.worn_late},
      {"worn_dropped", counters.worn_dropped},
      {"worn_unused", counters.worn_unused},
      {"worn_undecodable", counters.worn_undecodable},
      {"worn_wrong_size", counters.worn_wrong_size},
      {"ahrs_samples", counters.ahrs_samples},
      {"wearer_poses", counters.wearer_poses},
      {"invalid_samples", counters.invalid_samples},
      {"paired", counters.paired},
      {"no_pair", counters.no_pair},
      {"no_pose", counters.no_pose},
      {"no_calibration", counters.no_calibration},
      {"no_orientation", counters.no_orientation},
      {"wait_timeouts", counters.wait_timeouts},
      {"second_wearer", counters.second_wearer},
      {"wearer_restarts", counters.wearer_restarts},
  };
}

std::vector<std::string> lost_robot_images(const InboxCounters& counters) {
  std::vector<std::string> sentences;
  if (const auto lost = counters.robot_images_dropped + counters.robot_frames_dropped; lost > 0)
    sentences.push_back(std::to_string(lost) + " robot images came faster than they could be processed");
  if (const auto lost = counters.robot_undecodable + counters.robot_wrong_size; lost > 0)
    sentences.push_back(std::to_string(lost) + " robot images could not be decoded");
  return sentences;
}

}  // namespace cosight::inbox
