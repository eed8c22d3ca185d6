#pragma once

#include <Eigen/Core>

#include "robot_agent/vins/linearisation.hpp"
#include "robot_agent/vins/window.hpp"

namespace cosight::vins {

/// The first `count` unknowns taken out (Schur complement); what they were not told apart by stays unknown.
NormalEquations schur_complement(const NormalEquations& system, Eigen::Index count);

/// J and r with J^T J = H and J^T r = b, for H positive semidefinite up to rounding.
struct SquareRoot {
  Eigen::MatrixXd J;
  Eigen::VectorXd r;
};
SquareRoot square_root(const NormalEquations& system);

/// First strategy: the prior that is left when the oldest frame goes, and with it the landmarks it first saw.
/// Linearised at the window's present state.
Prior marginalise_oldest(const Window& window, const GraphOptions& options);

/// Second strategy: the prior without `frame`, whose sightings are dropped and whose IMU data go on to its
/// neighbour. Only the old prior knows of it.
Prior marginalise_frame(const Window& window, const GraphOptions& options, FrameId frame);

}  // namespace cosight::vins
