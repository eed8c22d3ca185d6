#pragma once

#include <vector>

#include "robot_agent/ekf/filter.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/map/map_archive.hpp"
#include "robot_agent/slam/landmark_tracks.hpp"
#include "robot_agent/slam/options.hpp"

namespace cosight::slam {

/// Keeps the filter within its budget: wrong landmarks go for good, those out of view go to the map.
class MapMaintenance {
 public:
  explicit MapMaintenance(const MapOptions& options) : options_(options) {}

  /// After the update: counts what was not fused, removes what failed or is long out of view. Returns how
  /// many left the filter.
  int tidy(ekf::Filter& filter, LandmarkTracks& tracks);

  /// How many landmarks the filter may still take, at most `wanted`. Those out of view the longest leave for
  /// them.
  int make_room(ekf::Filter& filter, LandmarkTracks& tracks, int wanted) const;

  /// Landmarks of the filter and those that left it, as others see them.
  std::vector<MapPoint> map() const { return archive_.points(); }

 private:
  bool is_wrong(const LandmarkTrack& track, const ekf::Filter& filter) const;

  MapOptions options_;
  map::MapArchive archive_;
};

}  // namespace cosight::slam
