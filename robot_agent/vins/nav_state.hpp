#pragma once

#include <Eigen/Core>

#include "robot_agent/vins/imu.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::vins {

/// What the window estimates of one frame (V2). B is the body, the IMU's own axes.
struct NavState {
  Pose T_WB;
  Eigen::Vector3d v_W = Eigen::Vector3d::Zero();  ///< [m/s]
  ImuBias bias;
};

}  // namespace cosight::vins
