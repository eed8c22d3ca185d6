#pragma once

#include <vector>

#include "experiments/planar/planar_filter.hpp"
#include "experiments/planar/wall_world.hpp"

namespace cosight::experiments {

struct Interval {
  double from = 0.0, to = 0.0;  ///< [s]
};

struct TrialOptions {
  WallWorldOptions world;
  PlanarFilterOptions filter;  ///< its noises are the world's
  bool collaborative = true;
  std::vector<Interval> overlaps{{8.0, 9.0}, {17.0, 19.0}};  ///< when pseudo-stereo is there
  int known_landmarks = 4;     ///< surveyed, across the first view; two at least
  double known_sigma = 0.002;  ///< [m] that the filter is told; they are exact
};

/// One frame of one run against the truth.
struct TrialStep {
  double t = 0.0;  ///< [s]
  PlanarPose truth;
  PlanarCamera estimate;
  double position_error = 0.0;  ///< [m]
  double heading_error = 0.0;   ///< [rad], absolute
  double position_sigma = 0.0;  ///< [m], sqrt of the trace, as the filter claims
  double position_nees = 0.0;   ///< expected 2
  double scale_error = 0.0;     ///< C14; nan without a converged landmark in view
};

struct TrialResult {
  std::vector<TrialStep> steps;
  std::vector<Eigen::Vector2d> true_landmarks;
  std::vector<PlanarFilter::Landmark> map;
};

/// One run of the planar simulation (C section 5.1); the same seed is the same world in every mode.
TrialResult run_trial(unsigned seed, const TrialOptions& options);

}  // namespace cosight::experiments
