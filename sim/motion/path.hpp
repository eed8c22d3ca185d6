#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/motion/cubic_spline.hpp"

namespace cosight::sim {

/// Where a path leads and how fast it is walked.
struct PathPlan {
  std::vector<Eigen::Vector2d> waypoints;  ///< on the floor, in W [m]
  double corner_radius = 1.0;              ///< corners are rounded to this [m]
  double speed = 0.8;                      ///< [m/s]
  double ramp = 2.0;                       ///< time from standing to full speed [s]
  double wait = 0.0;                       ///< stands still before it starts [s]
};

/// A polyline with rounded corners as a smooth curve over its length, and the way along it over time.
class Path {
 public:
  explicit Path(const PathPlan& plan);

  /// Length walked at time t since the start [m]: a smooth start, an even speed, a smooth stop at the end.
  double walked(double time) const;
  double speed(double time) const;

  Eigen::Vector2d at(double length) const { return curve_.at(length); }
  double heading(double length) const;  ///< [rad], not wrapped at a full turn

  double length() const { return curve_.last(); }
  double duration() const;  ///< [s], standing still at the start included

 private:
  PathPlan plan_;
  CubicSpline curve_;
  std::vector<double> heading_turns_;  ///< heading every kHeadingStep metres, unwrapped
};

}  // namespace cosight::sim
