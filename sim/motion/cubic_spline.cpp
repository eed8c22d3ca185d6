#include "sim/motion/cubic_spline.hpp"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace cosight::sim {

CubicSpline::CubicSpline(std::vector<double> parameter, std::vector<Eigen::Vector2d> points)
    : parameter_(std::move(parameter)), points_(std::move(points)) {
  const std::size_t n = points_.size();
  if (n < 2 || parameter_.size() != n || !std::is_sorted(parameter_.begin(), parameter_.end()) ||
      std::adjacent_find(parameter_.begin(), parameter_.end()) != parameter_.end()) {
    throw std::invalid_argument("a path needs two or more different points");
  }
  // Thomas' algorithm on the tridiagonal system of the second derivatives, zero at both ends.
  curvature_.assign(n, Eigen::Vector2d::Zero());
  std::vector<double> upper(n, 0.0);
  for (std::size_t k = 1; k + 1 < n; ++k) {
    const double before = parameter_[k] - parameter_[k - 1];
    const double after = parameter_[k + 1] - parameter_[k];
    const Eigen::Vector2d bend =
        6.0 * ((points_[k + 1] - points_[k]) / after - (points_[k] - points_[k - 1]) / before);
    const double pivot = 2.0 * (before + after) - before * upper[k - 1];
    upper[k] = after / pivot;
    curvature_[k] = (bend - before * curvature_[k - 1]) / pivot;
  }
  for (std::size_t k = n - 1; k-- > 1;)
    curvature_[k] -= upper[k] * curvature_[k + 1];
}

std::size_t CubicSpline::interval_of(double parameter) const {
  const auto above = std::upper_bound(parameter_.begin() + 1, parameter_.end() - 1, parameter);
  return static_cast<std::size_t>(above - parameter_.begin()) - 1;
}

Eigen::Vector2d CubicSpline::at(double parameter) const {
  const double inside = std::clamp(parameter, first(), last());
  const std::size_t k = interval_of(inside);
  const double h = parameter_[k + 1] - parameter_[k];
  const double b = (inside - parameter_[k]) / h;
  const double a = 1.0 - b;
  return a * points_[k] + b * points_[k + 1] +
         h * h / 6.0 * ((a * a * a - a) * curvature_[k] + (b * b * b - b) * curvature_[k + 1]) +
         (parameter - inside) * derivative(inside);
}

Eigen::Vector2d CubicSpline::derivative(double parameter) const {
  const double inside = std::clamp(parameter, first(), last());
  const std::size_t k = interval_of(inside);
  const double h = parameter_[k + 1] - parameter_[k];
  const double b = (inside - parameter_[k]) / h;
  const double a = 1.0 - b;
  return (points_[k + 1] - points_[k]) / h +
         h / 6.0 * ((1.0 - 3.0 * a * a) * curvature_[k] + (3.0 * b * b - 1.0) * curvature_[k + 1]);
}

}  // namespace cosight::sim
