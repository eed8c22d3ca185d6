#pragma once

#include <Eigen/Core>
#include <random>
#include <vector>

#include "shared/geometry/pose.hpp"

namespace cosight::sim {

struct RouteOptions {
  double start_speed =
      5.0;             ///< in motion, so that a window knows its scale at once; 0: it starts from rest [m/s]
  double hills = 0.4;  ///< amplitude of the ground's long waves [m]
};

/// A car's drive through city streets as a smooth function of time: it starts, cruises, brakes, stops at
/// lights and turns at corners. Everything has derivatives of its own, so that an IMU can be read off without
/// integration. W: x along the first street, z up. B: x forward, y left, z up.
class Route {
 public:
  /// `length` [m] of road; the same seed gives the same route.
  Route(double length, std::mt19937_64& random, const RouteOptions& options = {});

  double length() const { return length_; }
  double duration() const;  ///< [s] until `length` has been driven

  // Along the road; all hold before the start and after the end too.
  double distance(double t) const;      ///< s [m]
  double speed(double t) const;         ///< [m/s]
  double acceleration(double t) const;  ///< of the speed [m/s^2]
  double heading(double s) const;       ///< [rad]
  Eigen::Vector2d centre(double s) const;

  /// Where each corner begins [m], and the angle it turns by [rad].
  struct Corner {
    double begin = 0.0, length = 0.0, angle = 0.0;
  };
  const std::vector<Corner>& corners() const { return corners_; }

  /// A point `lateral` to the left of the road's centre [m].
  Eigen::Vector3d beside(double s, double lateral, double height) const;

  Pose T_WB(double t) const;
  Eigen::Vector3d velocity_W(double t) const;
  Eigen::Vector3d acceleration_W(double t) const;
  Eigen::Vector3d body_rate(double t) const;  ///< [rad/s], in B

 private:
  /// The speed goes from v_0 to v_1 on a smooth step.
  struct Phase {
    double t = 0.0, s = 0.0, duration = 0.0, v_0 = 0.0, v_1 = 0.0;
  };
  /// Height of the road: a sum of waves.
  struct Wave {
    double amplitude = 0.0, wave_number = 0.0, phase = 0.0;
  };

  void drive(double duration, double v);
  void drive_street(double until, std::mt19937_64& random);
  void turn(double angle);
  void tabulate_centre();
  const Phase& phase(double t) const;
  double curvature(double s) const;
  double height(double s, int derivative) const;

  double length_;
  std::vector<Phase> phases_;
  std::vector<Corner> corners_;
  std::vector<Wave> waves_;
  std::vector<Eigen::Vector2d> knots_;  ///< centre at multiples of kKnotStep
};

}  // namespace cosight::sim
