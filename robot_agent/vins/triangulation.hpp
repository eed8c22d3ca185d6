#pragma once

#include <optional>

#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// Inverse distance [1/m] of a landmark along its first bearing that fits all its observations best: linear
/// least squares of the points where its bearings should meet. Nothing with fewer than two observations, or
/// when the rays are so parallel that the answer is behind the camera or undetermined.
std::optional<double> triangulate(const Window& window, const Landmark& landmark);

/// Gives every landmark with enough observations a depth. One that cannot be triangulated starts at
/// `default_distance` [m], for the solver to move.
void triangulate_all(Window& window, std::size_t min_observations, double default_distance);

}  // namespace cosight::vins
