#pragma once

#include "robot_agent/frame_estimate.hpp"
#include "shared/geometry/camera_model.hpp"
#include "shared/geometry/uncertain_pose.hpp"

namespace cosight::overlap {

struct OverlapOptions {
  double near = 0.3;                 ///< [m] nothing nearer is expected by either camera
  double far = 200.0;                ///< [m] the scene's end
  double min_parallax_deg = 1.0;     ///< least useful angle between the two rays of a point
  double n_sigmas = 2.5;             ///< of the pose covariance, by which the regions are grown
  double min_area_fraction = 0.005;  ///< of either image; a smaller region is no overlap
};

/// |b| / (2 tan(alpha_min / 2)) clamped to [near, far]: farther points give no depth (equations, section 6).
double far_depth(double baseline, const OverlapOptions& options);

/// Where the two cameras see the same part of space (C section 2, Figure 2): the intersection of their
/// frustums cut at the far depth, projected into both images. The wearer's frustum is grown by the pose's
/// uncertainty before, so a region is only missing where there can be no overlap within n sigmas.
OverlapEstimate predict_overlap(const CameraModel& camera_S, const CameraModel& camera_F,
                                const UncertainPose& T_SF, const OverlapOptions& options = {});

/// Share of the image that a region covers, in [0, 1].
double covered_fraction(const std::vector<Eigen::Vector2d>& roi, const CameraModel& camera);

}  // namespace cosight::overlap
