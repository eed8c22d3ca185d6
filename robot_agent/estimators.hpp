#pragma once

namespace cosight::robot {

/// Which of the robot's two estimators run.
enum class Estimators { kSlam, kSlamAndVins, kVins };

/// How the two help each other where both run.
struct VinsHelp {
  bool guides_slam = true;   ///< slam's prediction takes VINS's velocity and the IMU's motion
  bool takes_depths = true;  ///< the distances that slam has from the wearer's view are priors of VINS's
};

constexpr bool has_slam(Estimators estimators) {
  return estimators != Estimators::kVins;
}
constexpr bool has_vins(Estimators estimators) {
  return estimators != Estimators::kSlam;
}

}  // namespace cosight::robot
