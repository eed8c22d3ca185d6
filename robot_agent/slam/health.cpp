#include "robot_agent/slam/health.hpp"

#include <algorithm>
#include <cmath>

namespace cosight::slam {

void Health::restart(Stamp stamp) {
  searched_ = fused_ = 0.0;
  last_stamp_ = stamp;
  last_match_ = stamp;
  lost_since_.reset();
}

void Health::note(Stamp stamp, const SearchCounts& search, const PseudoStereoCounts& pseudo_stereo) {
  const double dt = last_stamp_ ? std::max(0.0, to_seconds(stamp - *last_stamp_)) : 0.0;
  last_stamp_ = stamp;
  const double fade = std::exp(-dt / options_.window_s);
  searched_ = fade * searched_ + search.searched;
  fused_ = fade * fused_ + search.fused_pixels;
  if (search.fused_pixels + pseudo_stereo.fused + pseudo_stereo.initialised > 0) last_match_ = stamp;

  const bool finds_nothing = to_seconds(stamp - last_match_) > options_.lost_after_s;
  const bool believes_little = test_ratio() < options_.min_test_ratio;
  if (!finds_nothing && !believes_little) {
    lost_since_.reset();
  } else if (!lost_since_) {
    lost_since_ = stamp;
  }
}

bool Health::needs_reset(Stamp stamp) const {
  return options_.reset_after_s > 0.0 && lost_since_ &&
         to_seconds(stamp - *lost_since_) >= options_.reset_after_s;
}

double Health::test_ratio() const {
  constexpr double kTooFew = 5.0;  // landmarks: below it a share is chance
  return searched_ < kTooFew ? 1.0 : fused_ / searched_;
}

}  // namespace cosight::slam
