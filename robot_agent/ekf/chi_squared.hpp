#pragma once

#include <vector>

namespace cosight::ekf {

/// The value that a chi-squared variable with `dof` degrees of freedom stays under with `probability`
/// (0 < probability < 1). Infinite for probability >= 1.
double chi_squared_quantile(double probability, int dof);

/// The same for every dof up to a maximum, computed once; asking is free.
class ChiSquaredLimits {
 public:
  ChiSquaredLimits(double probability, int max_dof);

  double probability() const { return probability_; }
  double operator()(int dof) const;

 private:
  double probability_;
  std::vector<double> limits_;  ///< by dof; limits_[0] = 0
};

}  // namespace cosight::ekf
