#pragma once

#include <optional>
#include <vector>

#include "robot_agent/vins/preintegration.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// A frame before anything is known of its state.
struct UnplacedFrame {
  FeatureFrame features;
  std::optional<Preintegration> imu;  ///< from the frame before; nothing in the first
};

/// The gyroscope bias [rad/s] with which the IMU's rotations fit what the camera saw, whatever the
/// translations were: minimises over the bias and one direction t a pair of frames
///
///   sum ( t . ( f_i x R_ij(bias) f_j ) )^2,
///
/// which is zero when f_i, f_j and t lie in a plane. Nothing when too few features connect the frames, or
/// when the steps do not end.
std::optional<Eigen::Vector3d> estimate_gyroscope_bias(const std::vector<UnplacedFrame>& frames,
                                                       const Pose& T_BS);

}  // namespace cosight::vins
