#include "sim/sensors/inertial.hpp"

namespace cosight::sim {

InertialTruth feel(const Motion& T_WB, double time) {
  constexpr double kStep = 1e-3;  // [s]: the fourth derivative's share and the rounding are both below 1e-6
  const Pose before = T_WB(time - kStep);
  const Pose now = T_WB(time);
  const Pose after = T_WB(time + kStep);
  const Eigen::Vector3d acceleration_W = (after.p - 2.0 * now.p + before.p) / (kStep * kStep);
  const Eigen::AngleAxisd turned((before.q.conjugate() * after.q).normalized());
  return {turned.axis() * turned.angle() / (2.0 * kStep),
          now.q.conjugate() * (acceleration_W + Eigen::Vector3d(0.0, 0.0, kGravity))};
}

}  // namespace cosight::sim
