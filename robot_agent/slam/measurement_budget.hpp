#pragma once

#include <Eigen/Core>

namespace cosight::slam {

/// What a frame may cost, by a model of costs and not by the clock: the same bundles give the same bytes out.
/// The costs are those of one core at 2.6 GHz with AVX-512, fitted to the stage times of scripts/benchmark;
/// on a slower machine lower the limit in proportion.
struct BudgetOptions {
  double limit_ms = 0.0;     ///< of a frame; 0: no limit
  double reserved_ms = 2.0;  ///< for all but measuring: map, candidates, worn view
  double patch_us = 8.0;     ///< a landmark's warp and refinement
  double place_ns = 12.0;    ///< a place at which its patch is correlated
  double entry_ps = 55.0;    ///< an entry of P and a row of H: validation and update
};

/// Which landmarks a frame can afford to measure. What is too dear is left out; cheaper ones that come later
/// may still fit.
class MeasurementBudget {
 public:
  /// `state_size`: of the filter. `max_radius` [px]: half-width at which an ellipse is cut.
  MeasurementBudget(const BudgetOptions& options, int state_size, double n_sigmas, int max_radius);

  /// Whether a landmark with innovation covariance S [px^2] fits; if so it is charged.
  bool admit(const Eigen::Matrix2d& S);

  double spent_ms() const { return spent_ms_; }

 private:
  double cost_ms(const Eigen::Matrix2d& S) const;

  BudgetOptions options_;
  double update_ms_;  ///< of one landmark's two rows
  double n_sigmas_;
  double max_places_;
  double spent_ms_;
};

}  // namespace cosight::slam
