#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <string>
#include <vector>

#include "robot_agent/wearer/wearer_tracker.hpp"
#include "sim/scenario.hpp"

namespace cosight::wearer {

/// What one scan told of the free camera's place.
struct Answer {
  double time = 0.0;                                     ///< [s]
  Eigen::Vector3d error = Eigen::Vector3d::Zero();       ///< estimate - truth, in B [m]
  Eigen::Vector2d body_error = Eigen::Vector2d::Zero();  ///< of the body's axis, in B [m]
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();  ///< in B [m^2]
  double normalised = 0.0;                               ///< error^T covariance^-1 error
  bool seen = false;                                     ///< the scan showed the wearer
  std::string laser;
};

/// One run of the simulator's lasers, odometry and AHRS through a tracker.
struct WalkReport {
  std::vector<Answer> answers;
  std::size_t scans = 0;
  WearerCounters counters;
  double seconds = 0.0;  ///< spent in add_scan

  double rms() const;        ///< of the position [m]
  double worst() const;      ///< [m]
  double mean_nees() const;  ///< three when consistent
  double share() const;      ///< of the scans that were answered
};

struct WalkOptions {
  WearerOptions tracker;
  bool with_odometry = true;
  bool with_heading = true;  ///< the robot's orientation is known as slam would tell it, and the yaw offset
  double heading_sigma = 0.01;  ///< [rad]
};

/// A scene from the text of its yaml.
sim::Scenario scene_of(const std::string& yaml);

WalkReport walk(const sim::Scenario& scenario, std::uint64_t seed, const WalkOptions& options = {});

}  // namespace cosight::wearer
