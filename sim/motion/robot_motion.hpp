#pragma once

#include <cstdint>

#include "shared/geometry/pose.hpp"
#include "sim/motion/path.hpp"

namespace cosight::sim {

/// How the ground shakes the robot at full speed.
struct Shaking {
  double height = 0.002;  ///< [m]
  double angle = 0.003;   ///< roll and pitch [rad]
};

/// A wheeled robot on its path.
class RobotMotion {
 public:
  RobotMotion(const PathPlan& plan, const Shaking& shaking, std::uint64_t seed);

  /// T_WB: the point on the floor between the wheels, x forward, z up; `time` since the start [s].
  Pose at(double time) const;

  const Path& path() const { return path_; }

 private:
  Path path_;
  Shaking shaking_;
  double phase_ = 0.0;  ///< [rad] of the shaking, from the seed
};

}  // namespace cosight::sim
