// Extrinsics and time offset, refined while driving from a wrong first guess.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>

#include "robot_agent/vins/parameter_blocks.hpp"
#include "robot_agent/vins/uncertainty.hpp"
#include "robot_agent/vins/window_odometry.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;
using Matrix6 = Eigen::Matrix<double, 6, 6>;

constexpr double kPeriod = 0.1;  ///< of the camera [s]

/// A camera whose stamps are `delay` too early on the IMU's clock.
class LateCamera {
 public:
  LateCamera(SyntheticDrive& drive, double delay, double pixel_noise)
      : drive_(drive), delay_(delay), pixel_noise_(pixel_noise) {}

  FeatureFrame at(double stamp) {
    FeatureFrame frame = drive_.camera(stamp + delay_, pixel_noise_);
    frame.stamp = drive_.stamp(stamp);
    return frame;
  }

 private:
  SyntheticDrive& drive_;
  double delay_;
  double pixel_noise_;
};

WindowOptions refining(bool extrinsics, bool time_offset) {
  WindowOptions options;
  options.solver.graph.trust.mode = TrustMode::kFixed;
  options.solver.graph.trust.pixel_noise = 0.25;
  options.solver.graph.estimate_extrinsics = extrinsics;
  options.solver.graph.estimate_time_offset = time_offset;
  return options;
}

/// The window after `seconds` of a drive from the true first state.
Window drive_on(SyntheticDrive& drive, const WindowOptions& options, const Pose& T_BS, double delay,
                double seconds, double pixel_noise = 0.25) {
  LateCamera camera(drive, delay, pixel_noise);
  WindowOdometry odometry(options, drive.noise, T_BS);
  odometry.start(camera.at(0.0), drive.state(0.0), {});
  for (int i = 1; i <= static_cast<int>(seconds / kPeriod + 0.5); ++i) {
    const double t = kPeriod * i;
    odometry.process(camera.at(t), drive.imu(t - kPeriod, t));
  }
  return odometry.window();
}

Pose wrong(const Pose& T_BS) {
  const std::array<double, 6> off{0.03, -0.02, 0.03, 0.02, -0.015, 0.02};
  return moved(T_BS, off.data());
}

class Refined : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Refined, testing::Range(0U, 3U));

TEST_P(Refined, ExtrinsicsAreFoundWithinTheirOwnThreeSigma) {
  SyntheticDrive drive(GetParam());
  const WindowOptions options = refining(true, false);
  const Window window = drive_on(drive, options, wrong(drive.T_BS()), 0.0, 15.0);
  const Vector6 e = difference(window.T_BS, drive.T_BS());
  const Matrix6 P = extrinsics_covariance(window, options.solver.graph);
  std::printf(
      "position %.1f %.1f %.1f mm, rotation %.2f %.2f %.2f mrad; sigma %.1f mm %.2f mrad; %.1f of 6\n",
      1e3 * e(0), 1e3 * e(1), 1e3 * e(2), 1e3 * e(3), 1e3 * e(4), 1e3 * e(5),
      1e3 * std::sqrt(P.topLeftCorner<3, 3>().trace() / 3.0),
      1e3 * std::sqrt(P.bottomRightCorner<3, 3>().trace() / 3.0), e.dot(P.llt().solve(e)));
  EXPECT_LT(e.tail<3>().norm(), 5e-3);
  for (int i = 0; i < 6; ++i)
    EXPECT_LT(std::abs(e(i)), 3.0 * std::sqrt(P(i, i))) << i;
}

constexpr double kDelay = 0.008;  ///< of the camera's stamps [s]

TEST(Refined, TimeOffsetIsFoundToAMillisecondWithoutNoise) {
  SyntheticDrive drive(1);
  drive.noisy = false;
  const Window window = drive_on(drive, refining(false, true), drive.T_BS(), kDelay, 10.0, 0.0);
  std::printf("time offset %.2f ms of %.2f\n", 1e3 * window.time_offset, 1e3 * kDelay);
  EXPECT_NEAR(window.time_offset, kDelay, 1e-3);
}

class NoisyTimeOffset : public testing::TestWithParam<double> {};  ///< pixel noise
INSTANTIATE_TEST_SUITE_P(Pixels, NoisyTimeOffset, testing::Values(0.25, 0.5));

/// Where image noise takes part in how a sighting moves with the offset, the estimate goes to half a period;
/// where a short mean of the gyroscope does, it stays behind.
TEST_P(NoisyTimeOffset, IsFoundWithoutBiasAndAsWellAsItSays) {
  constexpr unsigned kSeeds = 10;
  WindowOptions options = refining(false, true);
  options.solver.graph.trust.pixel_noise = GetParam();
  options.solver.graph.trust.fixed_kernel = Kernel::kNone;  // the noise is Gaussian
  double mean = 0.0;
  double nees = 0.0;
  for (unsigned seed = 0; seed < kSeeds; ++seed) {
    SyntheticDrive drive(seed);
    const Window window = drive_on(drive, options, drive.T_BS(), kDelay, 6.0, GetParam());
    const double error = window.time_offset - kDelay;
    const double variance = time_offset_variance(window, options.solver.graph);
    std::printf("%.2f px: off by %.2f ms, sigma %.2f ms\n", GetParam(), 1e3 * error,
                1e3 * std::sqrt(variance));
    mean += error / kSeeds;
    nees += error * error / variance / kSeeds;
  }
  std::printf("%.2f px: off by %.2f ms in the mean, NEES %.2f\n", GetParam(), 1e3 * mean, nees);
  EXPECT_LT(std::abs(mean), 1.5e-3);
  EXPECT_GT(nees, 0.325);  // chi-squared of 10, 0.05 % to either side
  EXPECT_LT(nees, 3.14);
}

TEST(Refined, NothingChangesWhereItIsNotAskedFor) {
  SyntheticDrive drive(1);
  const Pose T_BS = wrong(drive.T_BS());
  const Window window = drive_on(drive, refining(false, false), T_BS, 0.0, 2.0);
  EXPECT_EQ(difference(window.T_BS, T_BS).norm(), 0.0);
  EXPECT_EQ(window.time_offset, 0.0);
}

TEST(Refined, CalibrationOfAWindowThatHasSeenNothingIsThatOfThePrior) {
  SyntheticDrive drive(1);
  const WindowOptions options = refining(true, true);
  const Window window = drive_on(drive, options, drive.T_BS(), 0.0, 0.0);
  EXPECT_EQ(window.prior.blocks.size(), 4U);
  EXPECT_NEAR(window.prior.J(15, 15), 1.0 / options.calibration.position, 1e-9);
  EXPECT_NEAR(window.prior.J(18, 18), 1.0 / options.calibration.rotation, 1e-9);
  EXPECT_NEAR(window.prior.J(21, 21), 1.0 / options.calibration.time_offset, 1e-9);
}

}  // namespace
}  // namespace cosight::vins
