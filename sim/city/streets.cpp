#include "sim/city/streets.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace cosight::sim {
namespace {

using Eigen::Vector2d;

constexpr double kHalfWidth = 11.0;     // [m]
constexpr double kSideHalfWidth = 6.5;  // [m]
constexpr double kSideLength = 50.0;    // from the middle of the street that it leaves [m]
constexpr double kBeyondCorner = 60.0;  // [m]
constexpr double kBeforeStart = 40.0;   // [m]
constexpr double kBeyondEnd = 300.0;    // [m]
constexpr double kAlmostSquare = 0.02;  // [rad]

Vector2d direction_at(const Route& route, double s) {
  // Streets run along x or y: what cos and sin leave of 1e-17 would make slanted houses.
  const double psi = route.heading(s);
  return {std::round(std::cos(psi)), std::round(std::sin(psi))};
}

/// Where the middle lines of the streets before and after a corner meet.
Vector2d meeting_point(const Route& route, const Route::Corner& corner) {
  const Vector2d begin = route.centre(corner.begin);
  const Vector2d along = direction_at(route, corner.begin);
  return begin + along * (route.centre(corner.begin + corner.length) - begin).dot(along);
}

std::vector<Street> main_streets(const Route& route) {
  std::vector<Street> streets;
  Vector2d from = route.centre(0.0);
  double before = kBeforeStart;
  double s = 0.0;
  const auto add = [&](const Vector2d& to, double beyond) {
    const Vector2d along = direction_at(route, s);
    streets.push_back({from - before * along, along, before + (to - from).norm() + beyond, kHalfWidth});
  };
  for (const Route::Corner& corner : route.corners()) {
    const Vector2d meeting = meeting_point(route, corner);
    add(meeting, kBeyondCorner);
    from = meeting;
    before = kBeyondCorner;
    s = corner.begin + corner.length;
  }
  add(route.centre(s) + kBeyondEnd * direction_at(route, s), 0.0);
  return streets;
}

/// The side street in which a vehicle ends that turns; nothing for one that stays on the streets.
void add_side_street(std::vector<Street>& streets, const Vehicle& vehicle) {
  const Pose T_WV = vehicle.T_WV(vehicle.to);
  const Vector2d end = T_WV.p.head<2>();
  const bool stays = std::any_of(streets.begin(), streets.end(),
                                 [&](const Street& street) { return street.contains(end, 0.0); });
  const Eigen::Vector3d ahead = T_WV.q * Eigen::Vector3d::UnitX();
  const double off_square = std::min(std::abs(ahead.x()), std::abs(ahead.y()));
  if (stays || off_square > kAlmostSquare) return;
  const Vector2d along(std::round(ahead.x()), std::round(ahead.y()));
  for (const Street& street : streets) {
    if (!street.main || std::abs(street.direction.dot(along)) > 0.5) continue;
    const double where = street.direction.dot(end - street.start);
    const Vector2d middle = street.at(where, 0.0);
    if (where < 0.0 || where > street.length || (end - middle).norm() > 2.0 * kSideLength) continue;
    streets.push_back({middle - kSideLength * along, along, 2.0 * kSideLength, kSideHalfWidth, false});
    return;
  }
}

/// What is left of the line when the parts inside other streets are taken out.
std::vector<HouseLine> outside(const HouseLine& line, std::size_t own, const std::vector<Street>& streets) {
  const Vector2d along = (line.to - line.from).normalized();
  const int axis = std::abs(along.x()) > 0.5 ? 0 : 1;
  std::vector<std::pair<double, double>> gaps;
  for (std::size_t k = 0; k < streets.size(); ++k) {
    const Vector2d low = streets[k].low();
    const Vector2d high = streets[k].high();
    const double across = line.from[1 - axis];
    if (k == own || across <= low[1 - axis] || across >= high[1 - axis]) continue;
    const double a = (low[axis] - line.from[axis]) * along[axis];
    const double b = (high[axis] - line.from[axis]) * along[axis];
    gaps.emplace_back(std::min(a, b), std::max(a, b));
  }
  std::sort(gaps.begin(), gaps.end());
  const double length = (line.to - line.from).norm();
  gaps.emplace_back(length, length);
  std::vector<HouseLine> parts;
  double begin = 0.0;
  for (const auto& [from, to] : gaps) {
    const double end = std::min(from, length);
    if (end > begin) parts.push_back({line.from + begin * along, line.from + end * along});
    begin = std::max(begin, to);
  }
  return parts;
}

}  // namespace

bool Street::contains(const Vector2d& p, double margin) const {
  return (p.array() > low().array() - margin).all() && (p.array() < high().array() + margin).all();
}

std::vector<Street> streets_of(const Route& route, const std::vector<Vehicle>& traffic) {
  std::vector<Street> streets = main_streets(route);
  for (const Vehicle& vehicle : traffic)
    add_side_street(streets, vehicle);
  return streets;
}

std::vector<HouseLine> house_lines(const std::vector<Street>& streets) {
  std::vector<HouseLine> lines;
  for (std::size_t k = 0; k < streets.size(); ++k) {
    const Vector2d low = streets[k].low();
    const Vector2d high = streets[k].high();
    const Vector2d corners[] = {low, {high.x(), low.y()}, high, {low.x(), high.y()}};
    for (std::size_t i = 0; i < 4; ++i) {
      for (const HouseLine& part : outside({corners[i], corners[(i + 1) % 4]}, k, streets))
        lines.push_back(part);
    }
  }
  return lines;
}

}  // namespace cosight::sim
