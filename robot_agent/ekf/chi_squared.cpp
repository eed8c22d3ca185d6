#include "robot_agent/ekf/chi_squared.hpp"

#include <boost/math/special_functions/gamma.hpp>
#include <limits>

namespace cosight::ekf {

double chi_squared_quantile(double probability, int dof) {
  if (probability >= 1.0) return std::numeric_limits<double>::infinity();
  if (probability <= 0.0 || dof <= 0) return 0.0;
  return 2.0 * boost::math::gamma_p_inv(0.5 * dof, probability);
}

ChiSquaredLimits::ChiSquaredLimits(double probability, int max_dof) : probability_(probability) {
  limits_.reserve(static_cast<std::size_t>(max_dof) + 1);
  for (int dof = 0; dof <= max_dof; ++dof)
    limits_.push_back(chi_squared_quantile(probability, dof));
}

double ChiSquaredLimits::operator()(int dof) const {
  const auto index = static_cast<std::size_t>(dof);
  return index < limits_.size() ? limits_[index] : chi_squared_quantile(probability_, dof);
}

}  // namespace cosight::ekf
