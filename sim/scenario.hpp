#pragma once

#include <string>
#include <vector>

#include "sim/carrier.hpp"
#include "sim/motion/gaze_plan.hpp"
#include "sim/motion/path.hpp"
#include "sim/motion/robot_motion.hpp"
#include "sim/motion/wearer_motion.hpp"
#include "sim/sensors/ahrs.hpp"
#include "sim/sensors/imu.hpp"
#include "sim/sensors/laser.hpp"
#include "sim/sensors/odometry.hpp"
#include "sim/sensors/tracker.hpp"
#include "sim/world/floor_plan.hpp"

namespace cosight::sim {

/// Everything a run consists of; the defaults are a small corridor with a turn.
struct Scenario {
  std::string name = "scene";
  double duration = 0.0;  ///< 0: until the robot has arrived [s]
  FloorPlan plan;
  PathPlan path;
  std::vector<PathPlan> passers_by;  ///< other people who walk through
  Shaking shaking;
  WearerPlan wearer;
  CameraPlan robot_camera;
  CameraPlan wearer_camera;
  GazePlan gaze;
  AhrsPlan ahrs;
  LaserPlan front_laser;
  LaserPlan rear_laser;
  ImuPlan imu;
  OdometryPlan odometry;
  TrackerPlan tracker;
  int known_points = 12;  ///< surveyed points in the first frame; 0: none
};

}  // namespace cosight::sim
