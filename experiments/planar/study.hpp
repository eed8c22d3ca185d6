#pragma once

#include <string>
#include <vector>

#include "experiments/figures.hpp"
#include "experiments/planar/trial.hpp"

namespace cosight::experiments {

/// Several runs of one setup, seeds `first_seed`, `first_seed` + 1, …
std::vector<TrialResult> run_trials(const TrialOptions& options, unsigned first_seed, int runs);

/// Averages over the runs, by step.
struct MeanCourse {
  std::vector<double> t;
  std::vector<double> position_error;  ///< mean absolute error [m]
  std::vector<double> scale_error;     ///< C14, over the runs that have one
  std::vector<double> position_sigma;  ///< as the filter claims [m]
};
MeanCourse mean_course(const std::vector<TrialResult>& trials);

/// Lost: not finite, or farther off at the end than half the path.
bool is_diverged(const TrialResult& trial, const WallWorldOptions& world);

/// Sets the figures of a mode; diverged runs count in all of them.
void summarise(const std::vector<TrialResult>& trials, const WallWorldOptions& world, const std::string& mode,
               Figures& figures);

/// Pearson's; 0 <= size of both the same.
double correlation(const std::vector<double>& a, const std::vector<double>& b);

/// The run whose final error is the median of all.
const TrialResult& median_trial(const std::vector<TrialResult>& trials);

}  // namespace cosight::experiments
