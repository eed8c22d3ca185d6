#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <span>
#include <unordered_map>

#include "robot_agent/wearer/planar_scan.hpp"

namespace cosight::wearer {

/// Remembers for how long each place around the robot has been occupied: what stands still is furniture.
/// Places are forgotten some time after they were seen last, so the drift of O does no harm.
class StaticMap {
 public:
  explicit StaticMap(const SceneOptions& options) : options_(options) {}

  bool is_static(const Eigen::Vector2d& p_O) const;

  /// Takes a scan in. Near to the `people` [m, O] no place gains; wherever a ray went on behind a place, it
  /// loses.
  void observe(const PlanarScan& scan, std::span<const Eigen::Vector2d> people);

  std::size_t size() const { return cells_.size(); }

 private:
  struct Cell {
    double occupied = 0.0;  ///< [s]
    Stamp updated = 0;
  };

  std::int64_t key_of(const Eigen::Vector2d& p_O) const;
  Eigen::Vector2d centre_of(std::int64_t key) const;
  void fill(const PlanarScan& scan, std::span<const Eigen::Vector2d> people);
  void clear(const PlanarScan& scan);

  SceneOptions options_;
  std::unordered_map<std::int64_t, Cell> cells_;
};

}  // namespace cosight::wearer
