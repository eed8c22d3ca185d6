#include <Eigen/Cholesky>
#include <cmath>

#include "robot_agent/ekf/filter.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::ekf {
namespace {

constexpr int kQ = CameraState::kOrientation;
constexpr int kV = CameraState::kVelocity;
constexpr int kOmega = CameraState::kAngularVelocity;

using Vector6d = Eigen::Matrix<double, 6, 1>;
using Matrix6d = Eigen::Matrix<double, 6, 6>;
using TwistJacobian = Eigen::Matrix<double, 6, CameraState::kDim>;

TwistJacobian twist_jacobian(const CameraState& x) {
  TwistJacobian H = TwistJacobian::Zero();
  H.block<3, 4>(0, kQ) = inverse_rotated_point_jacobian(x.q_WS, x.v_W);
  H.block<3, 3>(0, kV) = x.q_WS.toRotationMatrix().transpose();
  H.block<3, 3>(3, kOmega).setIdentity();
  return H;
}

}  // namespace

TwistReport Filter::update_twist(const UncertainTwist& measured) {
  constexpr int kCamera = CameraState::kDim;
  TwistReport report;
  report.gate = gates_(6);
  const CameraState x = camera();
  const TwistJacobian H = twist_jacobian(x);
  const Eigen::Index rest = state_.size() - kCamera;
  auto P = state_.P_lower();
  auto P_Ht = twist_P_Ht_.topRows(state_.size());
  P_Ht.topRows<kCamera>() = camera_covariance() * H.transpose();
  P_Ht.bottomRows(rest).noalias() = P.block(kCamera, 0, rest, kCamera) * H.transpose();
  const Matrix6d S = H * P_Ht.topRows<kCamera>() + measured.covariance;
  const Eigen::LLT<Matrix6d> llt(S);
  if (llt.info() != Eigen::Success) return report;

  Vector6d innovation;
  innovation << measured.v_S - x.q_WS.conjugate() * x.v_W, measured.omega_S - x.omega_S;
  const Vector6d whitened = llt.matrixL().solve(innovation);
  report.nis = whitened.squaredNorm();
  if (!std::isfinite(report.nis)) return report;
  report.outcome = report.nis <= report.gate ? Outcome::kFused : Outcome::kGated;
  if (report.outcome == Outcome::kGated) return report;

  llt.matrixU().solveInPlace<Eigen::OnTheRight>(P_Ht);  // W = P H^T L^-T
  state_.x() += P_Ht * whitened;
  P.selfadjointView<Eigen::Lower>().rankUpdate(P_Ht, -1.0);
  normalise_poses();
  return report;
}

}  // namespace cosight::ekf
