#include "robot_agent/vins/imu_motion.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <random>

#include "robot_agent/vins/motion_guide.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Vector6 = Eigen::Matrix<double, 6, 1>;

/// Of the camera between two instants of the drive, by its own path.
Vector6 true_twist(const SyntheticDrive& drive, double from, double to) {
  const Pose T_WS0 = drive.state(from).T_WB * drive.T_BS();
  const Pose T_WS1 = drive.state(to).T_WB * drive.T_BS();
  Vector6 twist;
  twist << T_WS1.q.conjugate() * (T_WS1.p - T_WS0.p), quaternion_log(T_WS0.q.conjugate() * T_WS1.q);
  return twist / (to - from);
}

Vector6 vector(const UncertainTwist& twist) {
  Vector6 result;
  result << twist.v_S, twist.omega_S;
  return result;
}

/// The drive's state with an error drawn from the covariance it is said to have.
UncertainNavState doubtful_state(const SyntheticDrive& drive, double t, std::mt19937& rng) {
  std::normal_distribution<double> normal;
  const auto draw = [&](double sigma) {
    return Eigen::Vector3d(sigma * normal(rng), sigma * normal(rng), sigma * normal(rng));
  };
  constexpr double kSigmas[5] = {0.1, 0.01, 0.03, 0.05, 0.002};  // p, R, v, biases
  UncertainNavState known;
  known.stamp = drive.stamp(t);
  known.state = drive.state(t);
  known.state.T_WB.p += draw(kSigmas[0]);
  known.state.T_WB.q = known.state.T_WB.q * quaternion_exp(draw(kSigmas[1]));
  known.state.v_W += draw(kSigmas[2]);
  known.state.bias.accelerometer += draw(kSigmas[3]);
  known.state.bias.gyroscope += draw(kSigmas[4]);
  for (int i = 0; i < 15; ++i)
    known.covariance(i, i) = kSigmas[i / 3] * kSigmas[i / 3];
  return known;
}

/// Mean of e^T P^-1 e over seeded spans of 0.1 s, six when the covariance is honest. The state is known at
/// the span's start, or `age` [s] before.
double mean_nees(double age) {
  constexpr int kRuns = 300;
  std::mt19937 rng(1);
  double sum = 0.0;
  for (int run = 0; run < kRuns; ++run) {
    SyntheticDrive drive(static_cast<unsigned>(run));
    const double t = 1.0 + 0.02 * run;
    UncertainNavState start = doubtful_state(drive, t - age, rng);
    if (age > 0.0)
      start = led_by_imu(start, {drive.imu(t - age, t), start.state.bias, drive.noise}, drive.gravity);
    const UncertainTwist twist = mean_twist(start, {drive.imu(t, t + 0.1), start.state.bias, drive.noise},
                                            drive.T_BS(), drive.gravity);
    const Vector6 error = vector(twist) - true_twist(drive, t, t + 0.1);
    sum += error.dot(twist.covariance.llt().solve(error));
  }
  return sum / kRuns;
}

TEST(ImuMotion, TwistOfATrueStateIsTheTruePathsOwn) {
  SyntheticDrive drive(1);
  drive.noisy = false;
  drive.bias = {{0.05, -0.02, 0.03}, {0.01, -0.005, 0.002}};
  const UncertainNavState start{drive.stamp(2.0), drive.state(2.0)};
  const UncertainTwist twist =
      mean_twist(start, {drive.imu(2.0, 2.1), drive.bias, drive.noise}, drive.T_BS(), drive.gravity);
  EXPECT_LT((vector(twist) - true_twist(drive, 2.0, 2.1)).norm(), 1e-4);
}

// Mean of 300 six-dimensional NEES: 6 +- 3 * sqrt(12 / 300).
TEST(ImuMotion, ErrorOfTheTwistIsAsLargeAsItsCovarianceSays) {
  EXPECT_NEAR(mean_nees(0.0), 6.0, 0.6);
}

TEST(ImuMotion, SoIsItWhenTheStateIsOlderThanTheSpan) {
  EXPECT_NEAR(mean_nees(0.3), 6.0, 0.6);
}

class MotionGuideTest : public testing::Test {
 protected:
  MotionGuideTest() {
    for (const ImuSample& sample : drive.imu(0.0, 1.0))
      guide.add_imu(sample);
  }

  void found(double t, double speed_error = 0.0) {
    UncertainNavState known{drive.stamp(t), drive.state(t)};
    known.state.v_W *= 1.0 + speed_error;
    guide.add(known.stamp, known);
  }
  std::optional<UncertainTwist> twist(double from, double to) const {
    return guide.twist(drive.stamp(from), drive.stamp(to));
  }

  SyntheticDrive drive{1};
  MotionGuide guide{drive.noise, drive.T_BS(), drive.gravity};
};

TEST_F(MotionGuideTest, KnowsNothingBeforeAStateIsFound) {
  EXPECT_FALSE(twist(0.2, 0.3));
}

TEST_F(MotionGuideTest, ItsAnswerDoesNotDependOnWhatWasFoundLater) {
  found(0.2);
  const auto before = twist(0.2, 0.3);
  found(0.3, 0.5);
  const auto after = twist(0.2, 0.3);
  ASSERT_TRUE(before && after);
  EXPECT_EQ(vector(*before), vector(*after));
}

TEST_F(MotionGuideTest, LeadsAnOlderStateOnByTheImu) {
  found(0.2);
  const auto led = twist(0.4, 0.5);
  ASSERT_TRUE(led);
  EXPECT_LT((vector(*led) - true_twist(drive, 0.4, 0.5)).norm(), 0.02);
}

TEST_F(MotionGuideTest, KnowsNothingAfterAFailureOrTooLong) {
  found(0.1);
  EXPECT_FALSE(twist(0.7, 0.8));
  guide.add(drive.stamp(0.2), std::nullopt);
  EXPECT_FALSE(twist(0.2, 0.3));
}

TEST_F(MotionGuideTest, TheLastSampleStandsForAFewMillisecondsOnly) {
  found(0.9);
  EXPECT_TRUE(twist(0.9, 1.01));
  EXPECT_FALSE(twist(0.9, 1.1));
}

}  // namespace
}  // namespace cosight::vins
