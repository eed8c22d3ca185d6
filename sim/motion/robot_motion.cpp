#include "sim/motion/robot_motion.hpp"

#include <cmath>
#include <numbers>

#include "sim/random.hpp"

namespace cosight::sim {
namespace {

/// Two sines of lengths that do not divide each other: as rough as a floor, and smooth.
double bumps(double length, double first, double second, double phase) {
  constexpr double kTurn = 2.0 * std::numbers::pi;
  return 0.6 * std::sin(kTurn * length / first + phase) +
         0.4 * std::sin(kTurn * length / second + 2.0 * phase);
}

}  // namespace

RobotMotion::RobotMotion(const PathPlan& plan, const Shaking& shaking, std::uint64_t seed)
    : path_(plan),
      shaking_(shaking),
      phase_(RandomStream(seed, "shaking").uniform(0.0, 2.0 * std::numbers::pi)) {}

Pose RobotMotion::at(double time) const {
  const double length = path_.walked(time);
  const Eigen::Vector2d place = path_.at(length);
  const double height = shaking_.height * bumps(length, 0.45, 0.32, phase_);
  const double pitch = shaking_.angle * bumps(length, 0.61, 0.38, phase_ + 1.0);
  const double roll = shaking_.angle * bumps(length, 0.83, 0.47, phase_ + 2.0);
  return {Eigen::AngleAxisd(path_.heading(length), Eigen::Vector3d::UnitZ()) *
              Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()) *
              Eigen::AngleAxisd(roll, Eigen::Vector3d::UnitX()),
          {place.x(), place.y(), height}};
}

}  // namespace cosight::sim
