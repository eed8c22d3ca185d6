#include "sim/sensors/tracker.hpp"

#include "sim/random.hpp"

namespace cosight::sim {

UncertainPose track(const TrackerPlan& plan, const Pose& T_SF, std::uint64_t seed, std::uint64_t frame) {
  RandomStream random(seed, "tracker", frame);
  Eigen::Matrix<double, 6, 1> sigmas;
  sigmas << plan.position_sigma, plan.rotation_sigma;
  Eigen::Matrix<double, 6, 1> error;
  for (Eigen::Index k = 0; k < 6; ++k)
    error[k] = sigmas[k] * random.normal();
  UncertainPose measured;
  measured.T.p = T_SF.p - error.head<3>();
  const Eigen::Vector3d turn = error.tail<3>();
  const double angle = turn.norm();
  const Eigen::Vector3d axis = angle > 0.0 ? Eigen::Vector3d(turn / angle) : Eigen::Vector3d::UnitX();
  measured.T.q = (Eigen::AngleAxisd(-angle, axis) * T_SF.q).normalized();
  measured.covariance = sigmas.cwiseAbs2().asDiagonal();
  return measured;
}

}  // namespace cosight::sim
