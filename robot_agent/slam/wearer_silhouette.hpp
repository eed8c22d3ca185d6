#pragma once

#include "robot_agent/slam/options.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/convex_polygon.hpp"
#include "shared/geometry/pose.hpp"

namespace cosight::slam {

/// Where the wearer's own body hides the scene from Cs: the convex hull [px] of an upright box around the
/// worn camera, which the pose of Cf places. A person who walks with the robot looks like a scene that stands
/// still, so nothing inside is used. Empty when the body is not in front of the camera, nearer than
/// `min_distance`, or the options give it no radius.
ConvexPolygon wearer_silhouette(const CameraModel& camera_S, const Pose& T_WS, const Pose& T_SF,
                                const BodyOptions& body);

}  // namespace cosight::slam
