#pragma once

#include <Eigen/Core>
#include <Eigen/Geometry>
#include <optional>

#include "robot_agent/inbox/options.hpp"
#include "robot_agent/inbox/stamped_history.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::inbox {

/// An orientation with the covariance of its error in the axes of the first frame [rad^2].
struct UncertainOrientation {
  Eigen::Quaterniond q = Eigen::Quaterniond::Identity();
  Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
};

/// Pose of Cf in Cs at `stamp`: linear in position and slerp in orientation between the neighbours where both
/// are near, else the nearest. Nothing when none is within `max_interval`. With weights a and b = 1 - a:
///
///   covariance = a Sigma_a + b Sigma_b + (motion between or beyond the samples)
///
/// The convex sum bounds the covariance of the interpolated pose for any correlation of the two errors. Cs is
/// the robot's camera at the pose's own stamp: how the robot moved to the stamp of its image is not in here.
std::optional<WearerPoseSample> interpolate_pose(const StampedHistory<WearerPoseSample>& poses, Stamp stamp,
                                                 const InterpolationOptions& options);

/// Orientation of the wearer's head in the AHRS's world at `stamp`, likewise.
std::optional<UncertainOrientation> interpolate_orientation(const StampedHistory<AhrsSample>& samples,
                                                            Stamp stamp, const InterpolationOptions& options);

/// Orientation of the free camera in W from that of the head, both errors in the axes of W.
UncertainOrientation free_camera_orientation(const UncertainOrientation& q_WH,
                                             const MountingOptions& options);

/// Fit to be used: finite, of unit quaternion, with a covariance that can be one.
bool is_valid(const WearerPoseSample& sample);
bool is_valid(const AhrsSample& sample);

}  // namespace cosight::inbox
