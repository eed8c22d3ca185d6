#pragma once

#include <string>
#include <vector>

#include "experiments/consistency/consistency_run.hpp"
#include "experiments/figures.hpp"

namespace cosight::experiments {

/// Averages over many runs, by step.
struct ConsistencyCourse {
  int runs = 0;
  std::vector<StepResult> mean;        ///< NIS as sums over all runs
  std::vector<double> final_errors;    ///< [m] of each run
  std::vector<double> heading_errors;  ///< [rad] of each run, at the end
  MatchCounts matches;                 ///< of all runs and steps
};

/// Seeds 1000, 1001, ….
ConsistencyCourse monte_carlo(const RunOptions& options, int runs);

/// The band that the average of `runs` chi-squared variables of `dof` degrees keeps with 95 %.
struct Band {
  double low = 0.0, high = 0.0;
  bool contains(double value) const { return value >= low && value <= high; }
};
Band average_band(int dof, int runs);

/// [m], of all runs.
double mean_final_error(const ConsistencyCourse& course);

/// What one number says of a course.
struct ConsistencyFigures {
  double pose_in_band = 0.0;  ///< share of steps whose average NEES lies inside its 95 % band
  double position_in_band = 0.0;
  double pose_nees = 0.0;  ///< average over steps and runs; expected 6
  double position_nees = 0.0;
  double nis_pixel = 0.0;  ///< per row, expected 1
  double nis_point = 0.0;
  double nis_joint = 0.0;
};
ConsistencyFigures figures_of(const ConsistencyCourse& course);

/// What a validation let through, as percent and microseconds a frame.
void summarise_matches(const ConsistencyCourse& course, const std::string& mode, Figures& figures);

/// Sets the figures of a mode.
void summarise(const ConsistencyCourse& course, const std::string& mode, Figures& figures);

}  // namespace cosight::experiments
