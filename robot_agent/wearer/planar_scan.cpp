#include "robot_agent/wearer/planar_scan.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <numbers>
#include <span>

namespace cosight::wearer {
namespace {

constexpr std::size_t kMaxRays = 20'000;

bool is_scan(const LaserScanSample& sample) {
  return std::isfinite(sample.angle_min) && std::isfinite(sample.angle_increment) &&
         sample.angle_increment != 0.0F && std::abs(sample.angle_min) < 10.0F &&
         std::isfinite(sample.range_min) && std::isfinite(sample.range_max) &&
         sample.range_min < sample.range_max && !sample.ranges.empty() && sample.ranges.size() <= kMaxRays &&
         std::abs(sample.angle_increment) * static_cast<float>(sample.ranges.size()) < 6.5F;
}

/// Worst distance of the points from the line through the first and the last [m].
double worst_distance(std::span<const ScanPoint> points) {
  const Eigen::Vector2d a = points.front().p_O;
  const Eigen::Vector2d along = (points.back().p_O - a).normalized();
  double worst = 0.0;
  for (const ScanPoint& point : points) {
    const Eigen::Vector2d d = point.p_O - a;
    worst = std::max(worst, std::abs(along.x() * d.y() - along.y() * d.x()));
  }
  return worst;
}

/// The distances between neighbours on a wall change little by little [m].
bool alike(double gap_a, double gap_b) {
  constexpr double kAlways = 0.15;
  constexpr double kRatio = 2.5;
  return std::max(gap_a, gap_b) <= std::max(kAlways, kRatio * std::min(gap_a, gap_b));
}

/// How many of the points lie on one straight line, from the first on.
std::size_t straight_run(std::span<const ScanPoint> points, double tolerance) {
  constexpr int kMaxMissing = 3;   // rays that may have brought nothing back
  constexpr double kMaxGap = 1.0;  // [m]
  const auto gap = [&](std::size_t k) { return (points[k].p_O - points[k - 1].p_O).norm(); };
  std::size_t count = 1;
  while (count < points.size() && points[count].ray - points[count - 1].ray <= kMaxMissing &&
         gap(count) <= kMaxGap && (count == 1 || alike(gap(count), gap(count - 1))) &&
         worst_distance(points.first(count + 1)) <= tolerance) {
    ++count;
  }
  return count;
}

}  // namespace

int PlanarScan::ray_to(const Eigen::Vector2d& p_O) const {
  const Eigen::Vector3d p_L = T_OL.inverse() * Eigen::Vector3d(p_O.x(), p_O.y(), T_OL.p.z());
  const double turn = std::remainder(std::atan2(p_L.y(), p_L.x()) - angle_min -
                                         0.5 * angle_increment * static_cast<double>(ranges.size()),
                                     2.0 * std::numbers::pi) +
                      0.5 * angle_increment * static_cast<double>(ranges.size());
  const double ray = std::round(turn / angle_increment);
  return ray >= 0.0 && ray < static_cast<double>(ranges.size()) ? static_cast<int>(ray) : -1;
}

std::optional<PlanarScan> seen_from_above(const LaserScanSample& sample, const LaserMount& mount,
                                          const Pose& T_OB, const SceneOptions& options) {
  if (!is_scan(sample)) return std::nullopt;
  PlanarScan scan;
  scan.stamp = sample.stamp;
  scan.T_OL = T_OB * mount.T_BL;
  scan.angle_min = static_cast<double>(sample.angle_min);
  scan.angle_increment = static_cast<double>(sample.angle_increment);
  scan.sigma = mount.sigma;
  scan.ranges.reserve(sample.ranges.size());
  for (std::size_t k = 0; k < sample.ranges.size(); ++k) {
    const float measured = sample.ranges[k];
    const bool returned =
        std::isfinite(measured) && measured >= sample.range_min && measured <= sample.range_max;
    const double range = returned ? static_cast<double>(measured) : 0.0;
    scan.ranges.push_back(range);
    if (!returned || range > options.max_range) continue;
    const double angle = scan.angle_min + static_cast<double>(k) * scan.angle_increment;
    const Eigen::Vector3d p_B =
        mount.T_BL * Eigen::Vector3d(range * std::cos(angle), range * std::sin(angle), 0.0);
    if (options.own_body.contains(Eigen::Vector2d(p_B.head<2>()))) continue;
    scan.points.push_back({(T_OB * p_B).head<2>(), static_cast<int>(k)});
  }
  return scan;
}

std::vector<ScanPoint> take_walls(std::vector<ScanPoint>& points, double length, double sigma) {
  constexpr std::size_t kFewest = 4;
  const double tolerance = 2.5 * sigma;
  std::vector<ScanPoint> walls;
  std::vector<ScanPoint> others;
  const std::span<const ScanPoint> all(points);
  for (std::size_t from = 0; from < all.size();) {
    const std::size_t run = straight_run(all.subspan(from), tolerance);
    const bool wall = run >= kFewest && (all[from + run - 1].p_O - all[from].p_O).norm() >= length;
    const std::size_t taken = wall ? run : 1;
    std::vector<ScanPoint>& kind = wall ? walls : others;
    for (std::size_t k = from; k < from + taken; ++k)
      kind.push_back(all[k]);
    from += taken;
  }
  points = std::move(others);
  return walls;
}

}  // namespace cosight::wearer
