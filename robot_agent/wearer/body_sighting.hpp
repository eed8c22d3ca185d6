#pragma once

#include <Eigen/Core>
#include <cstddef>
#include <vector>

#include "robot_agent/wearer/options.hpp"
#include "robot_agent/wearer/planar_scan.hpp"

namespace cosight::wearer {

/// One thing of the size of a leg, or of a torso when the laser is that high: its axis.
struct Limb {
  Eigen::Vector2d p_O = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();
  Eigen::Vector2d along_ray = Eigen::Vector2d::UnitX();  ///< from the laser to it
  /// The rays at both its sides went on behind it: nothing hides what stands beside it.
  bool stands_free = false;
};

enum class BodyPart { kTwoLegs, kOneLeg, kTorso };

/// Where a body's axis may be.
struct BodySighting {
  BodyPart part = BodyPart::kTwoLegs;
  Eigen::Vector2d p_O = Eigen::Vector2d::Zero();
  Eigen::Matrix2d covariance = Eigen::Matrix2d::Zero();  ///< of this one sighting
  double correlation = 1.0;  ///< for so many sightings in a row the error stays nearly the same
  double surprise = 0.0;     ///< -2 ln of how likely a body is to look like this
  std::vector<std::size_t> limbs;
};

/// The axis of an upright cylinder of known radius behind the points, the most probable one by
///
///   sum_k ( |p_k - c| - r )^2 / sigma^2  +  (c - c0)^T P0^-1 (c - c0),
///
/// c0 behind the middle of the points by pi r / 4, the mean depth of a cylinder's front. Its covariance is
/// that of the fit. `points` must not be empty.
Limb fit_cylinder(const std::vector<ScanPoint>& points, const Eigen::Vector2d& origin_O, double radius,
                  double sigma);

/// What of the points may be a leg or a torso. What touches the furniture may be a part of it: it is left
/// out.
std::vector<Limb> find_limbs(const PlanarScan& scan, const std::vector<ScanPoint>& points,
                             const std::vector<ScanPoint>& furniture, const SceneOptions& scene,
                             const PersonModel& person);

/// Every way in which the limbs make up a body: pairs of legs, single legs, or torsos.
std::vector<BodySighting> possible_bodies(const PlanarScan& scan, const std::vector<Limb>& limbs,
                                          const PersonModel& person);

}  // namespace cosight::wearer
