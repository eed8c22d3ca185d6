#include "sim/motion/path.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cosight::sim {
namespace {

constexpr double kPointSpacing = 0.35;  // [m] of the spline's points: dense enough to hold straights and arcs
constexpr double kHeadingStep = 0.1;    // [m]

double angle_of(const Eigen::Vector2d& v) {
  return std::atan2(v.y(), v.x());
}

/// Adds points on the straight from the last point to `end`, evenly spaced, `end` included.
void add_straight(std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& end) {
  const Eigen::Vector2d start = points.back();
  const int steps = static_cast<int>(std::ceil((end - start).norm() / kPointSpacing - 1e-6));
  for (int k = 1; k <= steps; ++k)
    points.emplace_back(start + (end - start) * (static_cast<double>(k) / steps));
}

/// Adds the arc that rounds `corner` between `before` and `after`; its tangent length is at most 0.45 of
/// either leg, so that neighbouring arcs never meet.
void add_corner(std::vector<Eigen::Vector2d>& points, const Eigen::Vector2d& before,
                const Eigen::Vector2d& corner, const Eigen::Vector2d& after, double radius) {
  const Eigen::Vector2d in = (corner - before).normalized();
  const Eigen::Vector2d out = (after - corner).normalized();
  const double turn = std::atan2(in.x() * out.y() - in.y() * out.x(), in.dot(out));
  if (std::abs(turn) < 1e-3) return add_straight(points, corner);
  if (std::abs(turn) > 0.97 * std::numbers::pi) {
    throw std::invalid_argument("a path turns back on itself at a waypoint: give it two corners");
  }
  const double half_tangent = std::tan(0.5 * std::abs(turn));
  const double shortest = std::min((corner - before).norm(), (after - corner).norm());
  const double used = std::min(radius, 0.45 * shortest / half_tangent);
  add_straight(points, corner - used * half_tangent * in);
  const Eigen::Vector2d start = points.back();
  const double side = turn > 0 ? 1.0 : -1.0;
  const Eigen::Vector2d centre = start + side * used * Eigen::Vector2d(-in.y(), in.x());
  const int steps = std::max(3, static_cast<int>(std::ceil(std::abs(turn) * used / kPointSpacing)));
  for (int k = 1; k <= steps; ++k) {
    const double angle = turn * k / steps;
    const Eigen::Vector2d arm = start - centre;
    points.emplace_back(centre + Eigen::Vector2d(std::cos(angle) * arm.x() - std::sin(angle) * arm.y(),
                                                 std::sin(angle) * arm.x() + std::cos(angle) * arm.y()));
  }
}

CubicSpline rounded(const PathPlan& plan) {
  if (plan.waypoints.size() < 2) throw std::invalid_argument("a path needs two or more waypoints");
  std::vector<Eigen::Vector2d> points{plan.waypoints.front()};
  for (std::size_t k = 1; k + 1 < plan.waypoints.size(); ++k) {
    add_corner(points, plan.waypoints[k - 1], plan.waypoints[k], plan.waypoints[k + 1], plan.corner_radius);
  }
  add_straight(points, plan.waypoints.back());
  std::vector<double> length{0.0};
  for (std::size_t k = 1; k < points.size(); ++k) {
    length.push_back(length.back() + (points[k] - points[k - 1]).norm());
  }
  return {std::move(length), std::move(points)};
}

/// Length and speed fraction of a start from standing: speed is the smoothstep 3x^2 - 2x^3 of x = time /
/// ramp.
double ramp_length(double x) {
  return x * x * x - 0.5 * x * x * x * x;
}

}  // namespace

Path::Path(const PathPlan& plan) : plan_(plan), curve_(rounded(plan)) {
  if (plan.speed <= 0.0 || plan.ramp <= 0.0) throw std::invalid_argument("speed and ramp must be above 0");
  const Eigen::Vector2d direction = curve_.derivative(0.0);
  heading_turns_.push_back(angle_of(direction));
  for (int k = 1; k * kHeadingStep < length() + kHeadingStep; ++k) {
    const double raw = angle_of(curve_.derivative(k * kHeadingStep));
    heading_turns_.push_back(heading_turns_.back() +
                             std::remainder(raw - heading_turns_.back(), 2.0 * std::numbers::pi));
  }
  // A short path never reaches full speed: shorten the ramp's share instead of overshooting the end.
  plan_.ramp = std::min(plan_.ramp, length() / plan_.speed);
}

double Path::duration() const {
  return plan_.wait + length() / plan_.speed + plan_.ramp;
}

double Path::walked(double time) const {
  const double t = time - plan_.wait;
  const double end = duration() - plan_.wait;
  if (t <= 0.0) return 0.0;
  if (t >= end) return length();
  const double per_ramp = plan_.speed * plan_.ramp;
  if (t < plan_.ramp) return per_ramp * ramp_length(t / plan_.ramp);
  if (t > end - plan_.ramp) return length() - per_ramp * ramp_length((end - t) / plan_.ramp);
  return 0.5 * per_ramp + plan_.speed * (t - plan_.ramp);
}

double Path::speed(double time) const {
  const double t = time - plan_.wait;
  const double x = std::clamp(std::min(t, duration() - plan_.wait - t) / plan_.ramp, 0.0, 1.0);
  return plan_.speed * x * x * (3.0 - 2.0 * x);
}

double Path::heading(double length) const {
  const double raw = angle_of(curve_.derivative(length));
  const double nearest =
      std::clamp(length / kHeadingStep, 0.0, static_cast<double>(heading_turns_.size() - 1));
  const double turns = heading_turns_[static_cast<std::size_t>(
      nearest + 0.5 < static_cast<double>(heading_turns_.size()) ? nearest + 0.5 : nearest)];
  return turns + std::remainder(raw - turns, 2.0 * std::numbers::pi);
}

}  // namespace cosight::sim
