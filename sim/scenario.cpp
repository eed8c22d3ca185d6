#include "sim/scenario.hpp"

namespace cosight::sim {

Pose optical_mount(const Eigen::Vector3d& place, double yaw, double pitch) {
  Eigen::Matrix3d R_BC;
  R_BC.col(0) = -Eigen::Vector3d::UnitY();  // right
  R_BC.col(1) = -Eigen::Vector3d::UnitZ();  // down
  R_BC.col(2) = Eigen::Vector3d::UnitX();   // forward
  const Eigen::Quaterniond turned(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                                  Eigen::AngleAxisd(-pitch, Eigen::Vector3d::UnitY()));
  return {(turned * Eigen::Quaterniond(R_BC)).normalized(), place};
}

}  // namespace cosight::sim
