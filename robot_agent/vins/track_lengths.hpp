#pragma once

#include <cstdint>
#include <map>

#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// How long features are followed. The paper (section 5.2) takes those tracked fewer than ten times for
/// outliers.
class TrackLengths {
 public:
  static constexpr int kInlierTracks = 10;

  void add(const FeatureFrame& frame);

  std::uint64_t sightings() const { return sightings_; }  ///< of all features, in all frames
  /// Those of features that were lost before they had been seen ten times. One that is still followed counts
  /// for none yet.
  std::uint64_t outlier_sightings() const { return outlier_sightings_; }

 private:
  std::map<FeatureId, int> followed_;  ///< times seen
  std::uint64_t sightings_ = 0;
  std::uint64_t outlier_sightings_ = 0;
};

}  // namespace cosight::vins
