#pragma once

#include <cstdint>
#include <vector>

#include "sim/motion/keyframes.hpp"

namespace cosight::sim {

/// A wearer who looks with the robot part of the time and aside the rest.
struct GazePlan {
  double ratio = 0.0;      ///< wanted share of the time in which the views overlap; 0: no such plan
  int intervals = 4;       ///< of looking with the robot, spread over the run; the first begins with it
  double aside = 2.0;      ///< how far the head turns away [rad]
  double turn_time = 0.8;  ///< that it takes [s]
};

/// How far the head is turned aside over time, to either side in turn: looking with the robot for `share` of
/// `duration` [s], in intervals of one length with pauses of different lengths between them.
std::vector<Keyframe> glances(const GazePlan& plan, double share, double duration, std::uint64_t seed);

}  // namespace cosight::sim
