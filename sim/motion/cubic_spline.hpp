#pragma once

#include <Eigen/Core>
#include <vector>

namespace cosight::sim {

/// A natural cubic spline through points of the plane: continuous to the second derivative, so that an IMU on
/// it feels no steps. Outside its range it goes straight on.
class CubicSpline {
 public:
  /// `parameter` strictly increasing, as many as points, at least two (std::invalid_argument).
  CubicSpline(std::vector<double> parameter, std::vector<Eigen::Vector2d> points);

  Eigen::Vector2d at(double parameter) const;
  Eigen::Vector2d derivative(double parameter) const;

  double first() const { return parameter_.front(); }
  double last() const { return parameter_.back(); }

 private:
  std::size_t interval_of(double parameter) const;

  std::vector<double> parameter_;
  std::vector<Eigen::Vector2d> points_;
  std::vector<Eigen::Vector2d> curvature_;  ///< second derivatives at the points
};

}  // namespace cosight::sim
