#pragma once

namespace cosight::robot {

/// Which of the robot's two estimators run.
enum class Estimators { kSlam, kSlamAndVins, kVins };

constexpr bool has_slam(Estimators estimators) {
  return estimators != Estimators::kVins;
}
constexpr bool has_vins(Estimators estimators) {
  return estimators != Estimators::kSlam;
}

}  // namespace cosight::robot
