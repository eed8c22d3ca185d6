#pragma once

#include <Eigen/Core>
#include <optional>
#include <vector>

#include "robot_agent/wearer/options.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::wearer {

/// Where a ray ended, seen from above.
struct ScanPoint {
  Eigen::Vector2d p_O = Eigen::Vector2d::Zero();  ///< [m]
  int ray = 0;
};

/// A scan seen from above, in the odometry's frame O.
struct PlanarScan {
  Stamp stamp = 0;
  Pose T_OL;
  double angle_min = 0.0, angle_increment = 0.0;  ///< [rad] in L
  double sigma = 0.0;                             ///< of a range [m]
  std::vector<double> ranges;                     ///< by ray [m]; 0: nothing came back
  std::vector<ScanPoint> points;                  ///< by ascending ray; near enough, not on the robot

  Eigen::Vector2d origin_O() const { return T_OL.p.head<2>(); }

  /// The ray that points nearest to a place, -1 when it is outside the arc.
  int ray_to(const Eigen::Vector2d& p_O) const;
};

/// Nothing for a scan that cannot be one (angles not finite, no step, too many rays).
std::optional<PlanarScan> seen_from_above(const LaserScanSample& sample, const LaserMount& mount,
                                          const Pose& T_OB, const SceneOptions& options);

/// Takes the points that lie on straight lines of `length` [m] or more out of `points`, in their order: walls
/// and the sides of large furniture, also where they are seen so obliquely that their points lie far apart.
std::vector<ScanPoint> take_walls(std::vector<ScanPoint>& points, double length, double sigma);

}  // namespace cosight::wearer
