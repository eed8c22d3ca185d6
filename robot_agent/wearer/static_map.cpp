#include "robot_agent/wearer/static_map.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace cosight::wearer {
namespace {

constexpr double kLongest = 0.1;  // what one sighting tells about the time before it [s]
constexpr double kFull = 4.0;     // more is not counted, so that what leaves is soon forgotten [s]
constexpr double kBehind = 0.2;   // a ray that ends so far behind a place went through it [m]
constexpr Stamp kForgotten = 15 * kNanosecondsPerSecond;

bool near_one_of(std::span<const Eigen::Vector2d> people, const Eigen::Vector2d& p_O, double radius) {
  return std::any_of(people.begin(), people.end(),
                     [&](const Eigen::Vector2d& person) { return (person - p_O).norm() < radius; });
}

/// The ray to a place and its two neighbours all ended far behind it.
bool looked_through(const PlanarScan& scan, const Eigen::Vector2d& p_O) {
  const int ray = scan.ray_to(p_O);
  if (ray < 1 || ray + 2 > static_cast<int>(scan.ranges.size())) return false;
  const double range = (p_O - scan.origin_O()).norm();
  const auto first = scan.ranges.begin() + ray - 1;
  return std::all_of(first, first + 3, [&](double measured) { return measured > range + kBehind; });
}

}  // namespace

std::int64_t StaticMap::key_of(const Eigen::Vector2d& p_O) const {
  const auto x = static_cast<std::int64_t>(std::floor(p_O.x() / options_.cell));
  const auto y = static_cast<std::int64_t>(std::floor(p_O.y() / options_.cell));
  return x * (std::int64_t{1} << 32) + y;
}

Eigen::Vector2d StaticMap::centre_of(std::int64_t key) const {
  const auto y = static_cast<std::int32_t>(key & 0xffffffff);
  const std::int64_t x = (key - y) / (std::int64_t{1} << 32);
  return options_.cell * Eigen::Vector2d(static_cast<double>(x) + 0.5, y + 0.5);
}

bool StaticMap::is_static(const Eigen::Vector2d& p_O) const {
  // The four cells that meet nearest to the point: range noise takes points over the border of a cell.
  constexpr std::array<double, 2> kHalves{-0.5, 0.5};
  for (const double x : kHalves) {
    for (const double y : kHalves) {
      const auto cell = cells_.find(key_of(p_O + options_.cell * Eigen::Vector2d(x, y)));
      if (cell != cells_.end() && cell->second.occupied >= options_.static_after) return true;
    }
  }
  return false;
}

void StaticMap::observe(const PlanarScan& scan, std::span<const Eigen::Vector2d> people) {
  clear(scan);
  fill(scan, people);
}

void StaticMap::fill(const PlanarScan& scan, std::span<const Eigen::Vector2d> people) {
  for (const ScanPoint& point : scan.points) {
    if (near_one_of(people, point.p_O, options_.person_radius)) continue;
    Cell& cell = cells_[key_of(point.p_O)];
    const double since = cell.updated == 0 ? 0.0 : to_seconds(scan.stamp - cell.updated);
    cell.occupied = std::min(cell.occupied + std::clamp(since, 0.0, kLongest), kFull);
    cell.updated = scan.stamp;
  }
}

void StaticMap::clear(const PlanarScan& scan) {
  for (auto& [key, cell] : cells_) {
    if (!looked_through(scan, centre_of(key))) continue;
    cell.occupied -= std::clamp(to_seconds(scan.stamp - cell.updated), 0.0, kLongest);
    cell.updated = scan.stamp;
  }
  std::erase_if(cells_, [&](const auto& entry) {
    const Cell& cell = entry.second;
    return cell.occupied < 0.0 || scan.stamp - cell.updated > kForgotten;
  });
}

}  // namespace cosight::wearer
