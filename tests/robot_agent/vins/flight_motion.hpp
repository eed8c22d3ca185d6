#pragma once

#include <Eigen/Core>
#include <vector>

#include "robot_agent/vins/preintegration.hpp"
#include "shared/evaluation/trajectory.hpp"

namespace cosight::vins {

/// Errors of a motion increment [alpha (m), theta (rad, axes of B_k+1), beta (m/s)].
using Vector9 = Eigen::Matrix<double, 9, 1>;
using Matrix9 = Eigen::Matrix<double, 9, 9>;

/// Poses that `increment_of` needs beside a span, on either side of both its ends.
constexpr std::size_t kStencil = 2;

/// The increment (V7-V9) between poses `from` and `to` of a body's trajectory whose stamps are evenly spaced,
/// for g_W = [0 0 gravity]. The velocities are central differences of fourth order.
MotionIncrement increment_of(const Trajectory& T_WB, std::size_t from, std::size_t to, double gravity);

/// `a` minus `b`.
Vector9 difference(const MotionIncrement& a, const MotionIncrement& b);

/// `poses` laid onto the truth: positions by the similarity that fits best, orientations by that and by one
/// constant turn of the camera, so that their mean difference is zero too. Same stamps in both.
Trajectory laid_onto(const Trajectory& truth, Trajectory poses);

/// T_WC of a camera as T_WB of its body.
Trajectory of_body(Trajectory T_WS, const Pose& T_BS);

/// Noise densities between two frequencies [Hz], mean over the axes: the mean spectral density of evenly
/// spaced samples, two-sided, so that white noise has the density a data sheet states. No walks.
ImuNoise noise_in_band(const std::vector<ImuSample>& samples, double low, double high);

}  // namespace cosight::vins
