#pragma once

#include <Eigen/Core>
#include <deque>
#include <optional>

#include "robot_agent/wearer/options.hpp"
#include "robot_agent/wearer/uncertain_angle.hpp"
#include "shared/dataset/sample.hpp"

namespace cosight::wearer {

/// From where a body stands to where its camera is:
///
///   p_SF = T_SB ( p_B + h e_z + R_BO R_OW R_WA R_AH p_HF )
///
/// h the height of the head; W the robot's map; A the AHRS's own world, turned from W by the yaw offset; all
/// worlds level. Without R_OA the camera is anywhere around the head.
class WornCamera {
 public:
  explicit WornCamera(const HeadOptions& options) : options_(options) {}

  /// Not finite, or not newer than the last: left out, false.
  bool add_ahrs(const AhrsSample& sample);
  /// R_WA = R_z(yaw_WA), as YawOffset has it.
  void set_yaw_offset(const UncertainAngle& yaw_WA) { yaw_WA_ = yaw_WA; }
  /// R_OW = R_z(yaw_OW), as it was at `stamp`.
  void set_map_yaw(Stamp stamp, const UncertainAngle& yaw_OW);

  /// Of W in O, while it is known.
  std::optional<UncertainAngle> yaw_OW(Stamp stamp) const;

  /// T_SF at `stamp` of one whose body's axis is at p_O; position only.
  WearerPoseSample pose(Stamp stamp, const Eigen::Vector2d& p_O, const Eigen::Matrix2d& covariance,
                        const Pose& T_OB) const;

 private:
  struct Offset {
    Eigen::Vector3d p = Eigen::Vector3d::Zero();  ///< in O [m]
    Eigen::Matrix3d covariance = Eigen::Matrix3d::Zero();
  };

  Offset from_head(Stamp stamp) const;
  const AhrsSample* ahrs_at(Stamp stamp) const;

  HeadOptions options_;
  std::deque<AhrsSample> ahrs_;
  std::optional<UncertainAngle> yaw_WA_;
  std::optional<UncertainAngle> yaw_OW_;
  Stamp yaw_OW_stamp_ = 0;
};

}  // namespace cosight::wearer
