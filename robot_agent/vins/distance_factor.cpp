#include "robot_agent/vins/distance_factor.hpp"

#include <cmath>

namespace cosight::vins {

KnownDistance seen_from(const KnownDistance& known, const Eigen::Vector3d& ray, const Pose& T) {
  // Times lambda, as in the reprojection factor.
  const Eigen::Vector3d h = T.q * ray + known.lambda * T.p;
  const double n = h.norm();
  // d (lambda / |h|) / d lambda
  const double slope = (1.0 - known.lambda * h.dot(T.p) / (n * n)) / n;
  return {known.lambda / n, std::abs(slope) * known.sigma};
}

KnownDistance fused(const KnownDistance& a, const KnownDistance& b) {
  const double weight_a = 1.0 / (a.sigma * a.sigma);
  const double weight_b = 1.0 / (b.sigma * b.sigma);
  const double weight = weight_a + weight_b;
  return {(weight_a * a.lambda + weight_b * b.lambda) / weight, std::sqrt(1.0 / weight)};
}

bool DistanceFactor::Evaluate(double const* const* parameters, double* residuals, double** jacobians) const {
  residuals[0] = (parameters[0][0] - known_.lambda) / known_.sigma;
  if (jacobians == nullptr || jacobians[0] == nullptr) return true;
  jacobians[0][0] = 1.0 / known_.sigma;
  jacobians[0][1] = 0.0;
  jacobians[0][2] = 0.0;
  return true;
}

}  // namespace cosight::vins
