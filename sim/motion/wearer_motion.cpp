#include "sim/motion/wearer_motion.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

#include "sim/random.hpp"

namespace cosight::sim {

WearerMotion::WearerMotion(WearerPlan plan, const Path& path, std::uint64_t seed)
    : plan_(std::move(plan)),
      path_(path),
      full_speed_(std::max(0.1, path.speed(0.5 * path.duration()))),
      phase_(RandomStream(seed, "gait").uniform(0.0, 2.0 * std::numbers::pi)) {}

double WearerMotion::length_at(double time) const {
  return path_.walked(time) + value_at(plan_.ahead, time);
}

double WearerMotion::gait(double time) const {
  return phase_ + std::numbers::pi * length_at(time) / plan_.step_length;
}

double WearerMotion::liveliness(double time) const {
  constexpr double kStep = 0.05;  // [s]
  const double speed = (length_at(time + kStep) - length_at(time - kStep)) / (2.0 * kStep);
  return std::min(1.3, std::abs(speed) / full_speed_);
}

Pose WearerMotion::feet(double time) const {
  const double length = length_at(time);
  const double heading = path_.heading(length);
  const Eigen::Vector2d left{-std::sin(heading), std::cos(heading)};
  const Eigen::Vector2d place = path_.at(length) + value_at(plan_.left, time) * left;
  return {Eigen::Quaterniond(Eigen::AngleAxisd(heading, Eigen::Vector3d::UnitZ())),
          {place.x(), place.y(), 0.0}};
}

Pose WearerMotion::head(double time) const {
  const double life = liveliness(time);
  const double step = gait(time);
  const Pose T_WP = feet(time);
  const double wander = 0.6 * std::sin(0.9 * time + phase_) + 0.4 * std::sin(2.3 * time + 2.0 * phase_);
  const double yaw = value_at(plan_.gaze_left, time) + value_at(plan_.aside, time) + plan_.glance * wander;
  const double pitch = -value_at(plan_.gaze_up, time) + 0.4 * plan_.glance * std::sin(1.3 * time + phase_) +
                       life * plan_.nod * std::cos(2.0 * step);
  const double roll = life * plan_.nod * std::sin(step);
  const Pose T_PH{
      Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) * Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
          Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()),
      {0.0, life * plan_.sway * std::sin(step), plan_.head_height + life * plan_.bob * std::cos(2.0 * step)}};
  return T_WP * T_PH;
}

}  // namespace cosight::sim
