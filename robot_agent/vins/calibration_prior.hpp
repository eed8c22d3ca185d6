#pragma once

#include "robot_agent/vins/factor_graph.hpp"
#include "robot_agent/vins/prior.hpp"

namespace cosight::vins {

/// How well the calibration is known where it is to be refined: standard deviations.
struct CalibrationUncertainty {
  double rotation = 0.035;    ///< of T_BS, about each axis: 2 degrees [rad]
  double position = 0.05;     ///< of T_BS, along each axis [m]
  double time_offset = 0.01;  ///< [s]
};

/// Adds to `prior` what is known beforehand of those parts of a window's calibration that `options` has
/// estimated. A motion need not tell all of them: a vehicle on a plane never tells how high its camera sits,
/// and without a prior that would be free to go anywhere.
void add_calibration_prior(Prior& prior, const Window& window, const GraphOptions& options,
                           const CalibrationUncertainty& uncertainty);

}  // namespace cosight::vins
