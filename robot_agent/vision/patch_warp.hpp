#pragma once

#include <Eigen/Core>
#include <array>
#include <cstddef>
#include <optional>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::vision {

/// A camera where it stood. The camera must outlive the view.
struct View {
  const CameraModel& camera;
  Pose T_WC;
};

/// A = d pixel_present / d pixel_reference of the small plane through p_W [m] that faces the reference
/// camera: right on average for what is known of one view. The two views may be of different cameras. Nothing
/// when p_W is behind one of them or the plane is seen edge-on.
std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W);

/// The same with the plane's normal given, in the axes of W; its sign does not matter.
std::optional<Eigen::Matrix2d> predicted_warp(const View& reference, const View& present,
                                              const Eigen::Vector3d& p_W, const Eigen::Vector3d& normal_W);

/// Which ways a surface seen along `ray` may face where rooms are built of walls, floors and ceilings:
/// towards the camera, turned from there to either side, and level. Unit vectors in the axes of `ray` and
/// `up`.
inline constexpr std::size_t kSurfaces = 4;
std::array<Eigen::Vector3d, kSurfaces> surfaces_along(const Eigen::Vector3d& ray, const Eigen::Vector3d& up);

}  // namespace cosight::vision
