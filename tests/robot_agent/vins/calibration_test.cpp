// Extrinsics and time offset, refined while driving from a wrong first guess.
#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <array>
#include <cmath>
#include <cstdio>
#include <map>
#include <utility>

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

/// A camera whose stamps are `delay` too early on the IMU's clock; it follows its features as a front end
/// does.
class LateCamera {
 public:
  LateCamera(SyntheticDrive& drive, double delay, double pixel_noise)
      : drive_(drive), delay_(delay), pixel_noise_(pixel_noise) {}

  FeatureFrame at(double stamp) {
    FeatureFrame frame = drive_.camera(stamp + delay_, pixel_noise_);
    frame.stamp = drive_.stamp(stamp);
    std::map<FeatureId, Eigen::Vector2d> now;
    for (TrackedFeature& feature : frame.features) {
      const auto before = last_.find(feature.id);
      if (before != last_.end())
        feature.sighting.velocity = (feature.sighting.point - before->second) / kPeriod;
      now.emplace(feature.id, feature.sighting.point);
    }
    last_ = std::move(now);
    return frame;
  }

 private:
  SyntheticDrive& drive_;
  double delay_;
  double pixel_noise_;
  std::map<FeatureId, Eigen::Vector2d> last_;
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
  camera.at(-kPeriod);
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

/// Without noise in the images: a feature's velocity is the difference of two sightings, so noise is in both,
/// and an offset of half a period averages it away. That draws the estimate towards half a period.
TEST(Refined, TimeOffsetIsFoundToFourMillisecondsWhereTheImagesAreWithoutNoise) {
  SyntheticDrive drive(1);
  constexpr double kDelay = 0.008;
  const Window window = drive_on(drive, refining(false, true), drive.T_BS(), kDelay, 10.0, 0.0);
  std::printf("time offset %.2f ms of %.2f\n", 1e3 * window.time_offset, 1e3 * kDelay);
  EXPECT_NEAR(window.time_offset, kDelay, 4e-3);
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
