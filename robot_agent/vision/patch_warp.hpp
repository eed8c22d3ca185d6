#pragma once

#include <Eigen/Core>
#include <optional>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::vision {

/// A camera where it stood. The camera must outlive the view.
struct View {
  const CameraModel& camera;
  Pose T_WC;
};

/// Which way the small plane around a point faces.
enum class PatchNormal {
  kTowardsReference,  ///< the camera that saw it first: right on average for what is known of one view
  kTowardsMean,       ///< half-way between both cameras: the least warp
};

/// A = d pixel_present / d pixel_reference of the small plane through p_W [m]. The two views may be of
/// different cameras. Nothing when p_W is behind one of them or the plane is seen edge-on.
std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W,
                                              PatchNormal normal = PatchNormal::kTowardsReference);

}  // namespace cosight::vision
