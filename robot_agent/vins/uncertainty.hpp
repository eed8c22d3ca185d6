#pragma once

#include <Eigen/Core>

#include "robot_agent/vins/factor_graph.hpp"

namespace cosight::vins {

/// Covariance of one frame's [dp (W), dtheta (B), dv, d accelerometer bias, d gyroscope bias] given
/// everything in the window, the prior included. Every state must be determined, as it is from a
/// start_prior() on.
Eigen::Matrix<double, 15, 15> state_covariance(const Window& window, const GraphOptions& options,
                                               FrameId frame);

/// Covariance of T_BS as [dp (B), dtheta (S)], given everything in the window. It must be estimated.
Eigen::Matrix<double, 6, 6> extrinsics_covariance(const Window& window, const GraphOptions& options);

/// Variance of the time offset [s^2], given everything in the window. It must be estimated.
double time_offset_variance(const Window& window, const GraphOptions& options);

}  // namespace cosight::vins
