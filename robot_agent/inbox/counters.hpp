#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace cosight::inbox {

/// What became of everything that was pushed.
struct InboxCounters {
  std::uint64_t robot_frames = 0;          ///< accepted
  std::uint64_t robot_lost = 0;            ///< jumps of the sequence
  std::uint64_t robot_out_of_order = 0;    ///< refused: not newer than the frame before
  std::uint64_t robot_images_dropped = 0;  ///< queue full: handed on without their image
  std::uint64_t robot_frames_dropped = 0;  ///< even the row without an image found no room
  std::uint64_t robot_undecodable = 0;     ///< handed on without an image
  std::uint64_t robot_wrong_size = 0;      ///< handed on without an image

  std::uint64_t worn_frames = 0;        ///< accepted
  std::uint64_t worn_lost = 0;          ///< jumps of the sequence
  std::uint64_t worn_out_of_order = 0;  ///< older than the one before; used if still in time
  std::uint64_t worn_late = 0;          ///< the robot frame of their time had already gone
  std::uint64_t worn_dropped = 0;       ///< queue full: the oldest goes
  std::uint64_t worn_unused = 0;        ///< nearest to no robot frame
  std::uint64_t worn_undecodable = 0;
  std::uint64_t worn_wrong_size = 0;

  std::uint64_t ahrs_samples = 0;
  std::uint64_t wearer_poses = 0;
  std::uint64_t invalid_samples =
      0;  ///< AHRS or pose that is no rotation, not finite, or of impossible covariance

  std::uint64_t paired = 0;           ///< robot frames with a worn frame and its pose
  std::uint64_t no_pair = 0;          ///< robot frames without a worn frame near enough
  std::uint64_t no_pose = 0;          ///< robot frames whose worn frame has no pose near enough
  std::uint64_t no_calibration = 0;   ///< pairs given up: the worn camera's calibration is not known yet
  std::uint64_t no_orientation = 0;   ///< pairs with a position only, and no AHRS near enough
  std::uint64_t wait_timeouts = 0;    ///< robot frames handed on because max_wait was over
  std::uint64_t second_wearer = 0;    ///< samples refused: another wearer with the same id is alive
  std::uint64_t wearer_restarts = 0;  ///< another writer took over from one that had gone or fallen silent
};

/// Name and value of each, in the order above, for reports.
std::vector<std::pair<std::string_view, std::uint64_t>> named_counts(const InboxCounters& counters);

/// Of the robot's own images that could not be used, one sentence for each reason; nothing when all could.
std::vector<std::string> lost_robot_images(const InboxCounters& counters);

}  // namespace cosight::inbox
