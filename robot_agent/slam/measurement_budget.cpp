#include "robot_agent/slam/measurement_budget.hpp"

#include <Eigen/LU>
#include <algorithm>
#include <cmath>
#include <numbers>

namespace cosight::slam {

MeasurementBudget::MeasurementBudget(const BudgetOptions& options, int state_size, double n_sigmas,
                                     int max_radius)
    : options_(options),
      update_ms_(2.0 * state_size * state_size * options.entry_ps * 1e-9),
      n_sigmas_(n_sigmas),
      max_places_((2.0 * max_radius + 1.0) * (2.0 * max_radius + 1.0)),
      spent_ms_(options.reserved_ms) {}

bool MeasurementBudget::admit(const Eigen::Matrix2d& S) {
  if (options_.limit_ms <= 0.0) return true;
  const double cost = cost_ms(S);
  if (!(spent_ms_ + cost <= options_.limit_ms)) return false;
  spent_ms_ += cost;
  return true;
}

/// The ellipse x^T S^-1 x <= n^2 has the area pi n^2 sqrt(det S).
double MeasurementBudget::cost_ms(const Eigen::Matrix2d& S) const {
  const double area = std::numbers::pi * n_sigmas_ * n_sigmas_ * std::sqrt(std::max(S.determinant(), 0.0));
  return options_.patch_us * 1e-3 + std::min(area, max_places_) * options_.place_ns * 1e-6 + update_ms_;
}

}  // namespace cosight::slam
