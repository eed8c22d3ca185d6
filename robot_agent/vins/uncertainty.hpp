#pragma once

#include <Eigen/Core>

#include "robot_agent/vins/factor_graph.hpp"

namespace cosight::vins {

/// Covariance of one frame's [dp (W), dtheta (B), dv, d accelerometer bias, d gyroscope bias] given
/// everything in the window, the prior included. Every state must be determined, as it is from a
/// start_prior() on.
Eigen::Matrix<double, 15, 15> state_covariance(const Window& window, const GraphOptions& options,
                                               FrameId frame);

}  // namespace cosight::vins
