#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <optional>
#include <vector>

#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::vision {

/// A point whose place in W is known, and where the camera sees it.
struct KnownPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();    ///< [m]
  Eigen::Vector2d pixel = Eigen::Vector2d::Zero();  ///< [px]
};

struct KnownPointsOptions {
  double sigma_pixel = 1.0;   ///< [px] noise of the pixels; scales the covariance
  double max_error_px = 4.0;  ///< [px] reprojection error above which a point is an outlier
  int max_hypotheses = 200;   ///< of RANSAC, at most; fewer when enough inliers are found
  double confidence = 0.999;  ///< that one hypothesis was of inliers only
  int min_inliers = 4;        ///< more where many points are given: four agree by chance
  std::uint32_t seed = 1;     ///< of RANSAC's draws: the same points give the same pose
};

struct KnownPointsPose {
  UncertainPose T_WC;         ///< covariance (J^T J)^-1 sigma^2 of [dp, dtheta] in the axes of W
  std::vector<bool> inliers;  ///< one for each point
  int inlier_count = 0;
  double rms_error_px = 0.0;  ///< of the inliers
};

/// Camera pose from at least four known points, all taken as right (equations, section 8). Nothing when the
/// geometry does not determine the pose or a point ends behind the camera.
std::optional<KnownPointsPose> estimate_pose(const CameraModel& camera, const std::vector<KnownPoint>& points,
                                             const KnownPointsOptions& options = {});

/// The same with wrong points among them: RANSAC over P3P, then refined on the inliers.
std::optional<KnownPointsPose> estimate_pose_ransac(const CameraModel& camera,
                                                    const std::vector<KnownPoint>& points,
                                                    const KnownPointsOptions& options = {});

/// Gauss-Newton on the reprojection errors of the points marked as inliers, from a pose that is near.
std::optional<KnownPointsPose> refine_pose(const CameraModel& camera, const std::vector<KnownPoint>& points,
                                           const std::vector<bool>& inliers, const Pose& T_WC,
                                           const KnownPointsOptions& options = {});

}  // namespace cosight::vision
