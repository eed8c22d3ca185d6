#pragma once

#include <ceres/sized_cost_function.h>

#include <Eigen/Core>

#include "shared/geometry/pose.hpp"

namespace cosight::vins {

/// The inverse distance of a landmark from the camera, measured by somebody else.
struct KnownDistance {
  double lambda = 0.0;  ///< [1/m]
  double sigma = 0.0;   ///< [1/m]
};

/// The same point's from another camera; `ray`: unit vector towards it from the first one, `T`: pose of the
/// first in the other.
KnownDistance seen_from(const KnownDistance& known, const Eigen::Vector3d& ray, const Pose& T);

/// Two measurements of one distance with independent errors.
KnownDistance fused(const KnownDistance& a, const KnownDistance& b);

/// A landmark's lambda against what is known of it where its host saw it:
///
///   r = (lambda - known lambda) / sigma
///
/// Parameters: LandmarkBlock.
class DistanceFactor final : public ceres::SizedCostFunction<1, 3> {
 public:
  explicit DistanceFactor(const KnownDistance& known) : known_(known) {}

  bool Evaluate(double const* const* parameters, double* residuals, double** jacobians) const override;

 private:
  KnownDistance known_;
};

}  // namespace cosight::vins
