#pragma once

#include <functional>

#include "shared/geometry/pose.hpp"

namespace cosight::sim {

/// Pose of a body in W at a time since the start [s]; smooth to the second derivative.
using Motion = std::function<Pose(double time)>;

/// What a perfect inertial sensor in the body's origin feels, in the body's axes.
struct InertialTruth {
  Eigen::Vector3d angular_velocity = Eigen::Vector3d::Zero();  ///< [rad/s]
  Eigen::Vector3d specific_force = Eigen::Vector3d::Zero();    ///< acceleration minus gravity [m/s^2]
};

constexpr double kGravity = 9.80665;  ///< along -z of W [m/s^2]

/// By central differences of the exact motion: one way for every motion, exact to about 1e-6.
InertialTruth feel(const Motion& T_WB, double time);

}  // namespace cosight::sim
