#pragma once

#include <ceres/cost_function.h>

#include "robot_agent/vins/prior.hpp"

namespace cosight::vins {

/// A Prior as a factor: residual + J (x - x_0). Parameters: the prior's blocks in their order.
class PriorFactor final : public ceres::CostFunction {
 public:
  /// `prior` must outlive the factor.
  explicit PriorFactor(const Prior& prior);

  const Prior& prior() const { return prior_; }

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  const Prior& prior_;
};

}  // namespace cosight::vins
