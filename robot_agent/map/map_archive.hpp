#pragma once

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <vector>

#include "robot_agent/frame_estimate.hpp"

namespace cosight::map {

/// When a landmark is good enough for the map that is kept.
struct MapArchiveOptions {
  int min_observations = 4;
  double max_sigma = 0.5;              ///< of the worst axis [m]
  std::size_t max_points = 1'000'000;  ///< 170 B each; newer ones are counted and left out
};

/// Every landmark that was ever good, with its last state, also after it left the filter.
class MapArchive {
 public:
  explicit MapArchive(const MapArchiveOptions& options = {}) : options_(options) {}

  /// The landmarks that are in the filter now. Good ones are added or brought up to date; those of the last
  /// call that are missing stay as they were, marked as no longer in the filter.
  void update(std::span<const MapPoint> in_filter);

  /// The filter found the landmark to be wrong: it leaves the map as well.
  void remove(std::uint64_t id) { points_.erase(id); }

  /// By ascending id.
  std::vector<MapPoint> points() const;
  std::size_t size() const { return points_.size(); }
  std::uint64_t left_out() const { return left_out_; }

 private:
  bool is_good(const MapPoint& point) const;

  MapArchiveOptions options_;
  std::map<std::uint64_t, MapPoint> points_;
  std::vector<std::uint64_t> in_filter_;  ///< of the last update, ascending
  std::uint64_t left_out_ = 0;            ///< good, but the map was full
};

/// Standard deviation along the worst axis [m].
double worst_sigma(const MapPoint& point);

}  // namespace cosight::map
