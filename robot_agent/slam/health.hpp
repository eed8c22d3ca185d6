#pragma once

#include <optional>

#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/options.hpp"
#include "shared/dataset/stamp.hpp"

namespace cosight::slam {

/// Says when the filter is lost: it has found nothing for a while, or too little of what it looked for.
class Health {
 public:
  explicit Health(const HealthOptions& options) : options_(options) {}

  /// After each frame since the map began.
  void note(Stamp stamp, const SearchCounts& search, const PseudoStereoCounts& pseudo_stereo);
  /// A map begins.
  void restart(Stamp stamp);

  bool is_lost() const { return lost_since_.has_value(); }
  /// Not lost, and the last frame had a match that holds.
  bool is_sure() const { return !is_lost() && last_stamp_ && *last_stamp_ == last_match_; }
  /// Lost for so long that a new map is better than hope.
  bool needs_reset(Stamp stamp) const;
  /// Share of the landmarks looked for that were found and believed, over the last `window_s`; 1 before any.
  double test_ratio() const;

 private:
  HealthOptions options_;
  double searched_ = 0.0, fused_ = 0.0;  ///< sums that fade
  std::optional<Stamp> last_stamp_;
  Stamp last_match_ = 0;
  std::optional<Stamp> lost_since_;
};

}  // namespace cosight::slam
