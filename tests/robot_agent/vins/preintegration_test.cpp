#include "robot_agent/vins/preintegration.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>

#include "robot_agent/vins/parameter_blocks.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Vector9 = Eigen::Matrix<double, 9, 1>;

/// How far `estimate` is from `truth`, in the order and axes of the pre-integration's error state.
Vector9 error(const NavState& start, const NavState& truth, const NavState& estimate) {
  const Eigen::Matrix3d R_i_T = start.T_WB.q.toRotationMatrix().transpose();
  Vector9 e;
  e << R_i_T * (estimate.T_WB.p - truth.T_WB.p), quaternion_log(truth.T_WB.q.conjugate() * estimate.T_WB.q),
      R_i_T * (estimate.v_W - truth.v_W);
  return e;
}

TEST(Preintegration, CarriesATrueStateAlongATruePath) {
  SyntheticDrive drive(1);
  drive.noisy = false;
  drive.bias = {{0.05, -0.02, 0.03}, {0.01, -0.005, 0.002}};
  const Preintegration imu(drive.imu(2.0, 2.5), drive.bias, drive.noise);
  const NavState end = imu.propagate(drive.state(2.0), drive.gravity);
  EXPECT_LT((end.T_WB.p - drive.state(2.5).T_WB.p).norm(), 2e-5);
  EXPECT_LT((end.v_W - drive.state(2.5).v_W).norm(), 5e-5);
  EXPECT_LT(quaternion_log(end.T_WB.q.conjugate() * drive.state(2.5).T_WB.q).norm(), 1e-5);
}

TEST(Preintegration, CorrectsForABiasAsReintegrationWould) {
  SyntheticDrive drive(2);
  Preintegration imu(drive.imu(0.0, 0.3), {}, drive.noise);
  const ImuBias bias{{0.02, -0.03, 0.01}, {0.002, 0.003, -0.001}};
  const MotionIncrement first_order = imu.corrected(bias);
  imu.repropagate(bias);
  EXPECT_LT((first_order.alpha - imu.increment().alpha).norm(), 2e-6);
  EXPECT_LT((first_order.beta - imu.increment().beta).norm(), 1e-5);
  EXPECT_LT(first_order.gamma.angularDistance(imu.increment().gamma), 1e-6);
}

TEST(Preintegration, JoinedSpansEqualOneLongSpan) {
  SyntheticDrive drive(3);
  drive.noisy = false;
  Preintegration joined(drive.imu(1.0, 1.2), {}, drive.noise);
  joined.append(Preintegration(drive.imu(1.2, 1.5), {}, drive.noise));
  const Preintegration whole(drive.imu(1.0, 1.5), {}, drive.noise);
  EXPECT_NEAR(joined.duration(), 0.5, 1e-9);
  EXPECT_LT((joined.increment().alpha - whole.increment().alpha).norm(), 1e-9);
  EXPECT_LT((joined.covariance() - whole.covariance()).norm(), 1e-12);
}

/// Mean of e^T P^-1 e over seeded spans, P scaled by `boast`^2; nine when the covariance is honest.
double mean_nees(double boast) {
  double sum = 0.0;
  constexpr int kSpans = 200;
  for (unsigned seed = 0; seed < kSpans; ++seed) {
    SyntheticDrive drive(seed);
    const double t = 0.05 * seed;
    const Preintegration imu(drive.imu(t, t + 0.5), {}, drive.noise);
    const NavState start = drive.state(t);
    const Vector9 e = error(start, drive.state(t + 0.5), imu.propagate(start, drive.gravity));
    const Eigen::Matrix<double, 9, 9> P = boast * boast * imu.covariance().topLeftCorner<9, 9>();
    sum += e.dot(P.llt().solve(e));
  }
  return sum / kSpans;
}

TEST(Preintegration, CovarianceMatchesTheErrorsThatNoiseMakes) {
  EXPECT_NEAR(mean_nees(1.0), 9.0, 9.0 * 0.11);  // 95 % band of 200 runs is 9 +- 0.59
}

TEST(Preintegration, BoastfulCovarianceWouldBeCaught) {
  EXPECT_GT(mean_nees(1.0 / 1.5), 15.0);
}

}  // namespace
}  // namespace cosight::vins
