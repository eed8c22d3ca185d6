#pragma once

#include <optional>

#include "robot_agent/ekf/triangulation.hpp"
#include "robot_agent/frame_bundle.hpp"
#include "robot_agent/frame_estimate.hpp"
#include "robot_agent/slam/options.hpp"
#include "robot_agent/wearer/uncertain_angle.hpp"
#include "shared/geometry/convex_polygon.hpp"

namespace cosight::slam {

/// One frame of the wearer's camera, ready to be measured against: the views overlap.
struct StereoView {
  const GrayImage* image_F = nullptr;
  ekf::StereoRig rig;
  UncertainPose T_SF_sensed;  ///< what the sensors say; the matches may make that of `rig` better
  /// For measurements: what the sensors know of Cf's pose, and the better one to linearise at. The matches
  /// that made it better are measured themselves, and must not count twice.
  ekf::StereoRig sensed_rig() const;

  OverlapEstimate overlap;
  double near = 0.3;                                 ///< nothing nearer to Cs is looked for [m]
  Eigen::Vector3d up_S = -Eigen::Vector3d::UnitY();  ///< z of W
  ConvexPolygon silhouette;  ///< the wearer's own body in Cs [px]: nothing inside is used
};

/// T_SF of a worn view; its orientation from the AHRS where only a position is given:
/// R_SF = R_WS^T R_z(yaw) R_WF, with the errors of all three in the axes of S. `yaw`: from the AHRS's north,
/// as the view has it, to W. Nothing without any orientation.
std::optional<UncertainPose> wearer_pose(const WearerView& wearer, const UncertainPose& T_WS,
                                         const wearer::UncertainAngle& yaw = {0.0, 0.0});

/// Enough parallax, and a depth that is known well enough by the eleven uncertain inputs (C section 3.2).
bool has_depth(const ekf::StereoPoint& point, const ekf::StereoRig& rig, const PseudoStereoOptions& options);

}  // namespace cosight::slam
