#include "robot_agent/slam/wearer_silhouette.hpp"

#include <vector>

namespace cosight::slam {

ConvexPolygon wearer_silhouette(const CameraModel& camera_S, const Pose& T_WS, const Pose& T_SF,
                                const BodyOptions& body) {
  if (body.radius <= 0.0 || T_SF.p.z() < body.min_distance) return {};
  const Eigen::Vector3d eyes_W = T_WS * T_SF.p;
  const Pose T_SW = T_WS.inverse();
  // Across the line of sight, level: the box always shows its full width.
  const Eigen::Vector3d right_W = Eigen::Vector3d::UnitZ().cross(eyes_W - T_WS.p).normalized();
  std::vector<Eigen::Vector2d> corners;
  for (const double side : {-body.radius, body.radius}) {
    for (const double up :
         {body.above_eyes, -0.35 * body.below_eyes, -0.7 * body.below_eyes, -body.below_eyes}) {
      const Eigen::Vector3d p_W = eyes_W + side * right_W + up * Eigen::Vector3d::UnitZ();
      if (const auto pixel = camera_S.project(T_SW * p_W)) corners.push_back(*pixel);
    }
  }
  return clip(convex_hull(std::move(corners)),
              {Eigen::Vector2d::Zero(), Eigen::Vector2d(camera_S.width - 1, camera_S.height - 1)});
}

}  // namespace cosight::slam
