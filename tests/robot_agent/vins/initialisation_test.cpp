#include "robot_agent/vins/initialisation.hpp"

#include <gtest/gtest.h>

#include "robot_agent/vins/adaptive_vins.hpp"
#include "robot_agent/vins/velocity_and_gravity.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

std::vector<UnplacedFrame> frames_of(SyntheticDrive& drive, double from, int count, double pixel_noise) {
  std::vector<UnplacedFrame> frames;
  for (int i = 0; i < count; ++i) {
    const double t = from + 0.1 * i;
    UnplacedFrame frame{drive.camera(t, pixel_noise), std::nullopt};
    if (i > 0) frame.imu.emplace(drive.imu(t - 0.1, t), ImuBias(), drive.noise);
    frames.push_back(std::move(frame));
  }
  return frames;
}

/// For an accelerometer whose bias is known to 2 cm/s^2: the scale is seen sooner.
InitialisationOptions calibrated() {
  InitialisationOptions options;
  options.prior.accelerometer_bias = 0.02;
  return options;
}

TEST(GyroscopeBias, IsFoundFromRotationsAlone) {
  SyntheticDrive drive(1);
  drive.noisy = false;
  drive.bias.gyroscope = {0.02, -0.05, 0.08};
  const auto bias = estimate_gyroscope_bias(frames_of(drive, 0.0, 11, 0.0), drive.T_BS());
  ASSERT_TRUE(bias);
  EXPECT_LT((*bias - drive.bias.gyroscope).norm(), 1e-4);
}

TEST(GyroscopeBias, IsUnknownWithoutCommonFeatures) {
  SyntheticDrive drive(1);
  auto frames = frames_of(drive, 0.0, 11, 0.0);
  for (auto& frame : frames)
    frame.features.features.clear();
  EXPECT_FALSE(estimate_gyroscope_bias(frames, drive.T_BS()));
}

TEST(VelocityAndGravity, AreThoseOfThePathWhenNothingIsNoisy) {
  SyntheticDrive drive(2);
  drive.noisy = false;
  const auto start = estimate_velocity_and_gravity(frames_of(drive, 1.0, 11, 0.0), drive.T_BS(), 9.81);
  ASSERT_TRUE(start);
  const NavState truth = drive.state(1.0);
  EXPECT_LT((start->v_B - truth.T_WB.q.conjugate() * truth.v_W).norm(), 0.01);
  EXPECT_LT((start->g_B - truth.T_WB.q.conjugate() * Eigen::Vector3d(0, 0, 9.81)).norm(), 0.01);
}

class Cold : public testing::TestWithParam<unsigned> {};
INSTANTIATE_TEST_SUITE_P(Seeds, Cold, testing::Range(0U, 5U));

TEST_P(Cold, StartFindsScaleGravityAndVelocityWithNoise) {
  SyntheticDrive drive(GetParam());
  drive.bias.gyroscope = {0.01, -0.02, 0.03};
  const double t = 0.7 * GetParam();
  WindowOptions window_options;
  window_options.solver.graph.trust.pixel_noise = 0.5;
  const Initialisation result =
      initialise(frames_of(drive, t, 16, 0.25), drive.T_BS(), calibrated(), window_options);
  ASSERT_EQ(result.outcome, InitialisationOutcome::kReady) << to_string(result.outcome);
  const Window& window = *result.window;
  const double length = (window.frames.back().state.T_WB.p - window.frames.front().state.T_WB.p).norm();
  const double truth = (drive.state(t + 1.5).T_WB.p - drive.state(t).T_WB.p).norm();
  EXPECT_NEAR(length / truth, 1.0, 4.0 * result.scale_deviation + 1e-3);
  const Eigen::Vector3d up = window.frames.back().state.T_WB.q.conjugate() * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d up_truth = drive.state(t + 1.5).T_WB.q.conjugate() * Eigen::Vector3d::UnitZ();
  EXPECT_LT((up - up_truth).norm(), 0.03);
}

/// What three seconds with a bias in the accelerometer come to, where it is told to be known to `sigma`
/// [m/s^2]. They are long enough to see the bias whatever was told.
Initialisation start_with_bias(unsigned seed, double bias, double sigma) {
  SyntheticDrive drive(seed);
  drive.bias.accelerometer.z() = bias;
  InitialisationOptions options;
  options.prior.accelerometer_bias = sigma;
  WindowOptions window_options;
  window_options.solver.graph.trust.pixel_noise = 0.5;
  return initialise(frames_of(drive, 0.0, 31, 0.25), drive.T_BS(), options, window_options);
}

TEST_P(Cold, StartWithABiasOfSixSigmasIsNone) {
  const Initialisation result = start_with_bias(GetParam(), 0.3, 0.05);
  EXPECT_EQ(result.outcome, InitialisationOutcome::kInconsistent) << to_string(result.outcome);
  EXPECT_FALSE(result.window);
  EXPECT_LT(result.typical_misfit, InitialisationOptions().max_misfit) << "the bias alone speaks against it";
  EXPECT_LT(result.scale_deviation, InitialisationOptions().max_scale_deviation) << "likewise";
}

TEST_P(Cold, StartWithTheSameBiasIsGivenWhereItCanBeBelieved) {
  const Initialisation result = start_with_bias(GetParam(), 0.3, 0.1);
  ASSERT_EQ(result.outcome, InitialisationOutcome::kReady) << to_string(result.outcome);
  EXPECT_NEAR(result.window->frames.back().state.bias.accelerometer.z(), 0.3, 0.1);
}

TEST_P(Cold, StartWithABiasOfTwoSigmasIsGiven) {
  const Initialisation result = start_with_bias(GetParam(), 0.1, 0.05);
  ASSERT_EQ(result.outcome, InitialisationOutcome::kReady) << to_string(result.outcome);
}

TEST(Initialisation, SaysThatTooFewFramesAreThere) {
  SyntheticDrive drive(1);
  EXPECT_EQ(initialise(frames_of(drive, 0.0, 5, 0.25), drive.T_BS(), {}, {}).outcome,
            InitialisationOutcome::kTooFewFrames);
}

TEST(Initialisation, SaysThatNothingMoves) {
  SyntheticDrive drive(1);
  auto frames = frames_of(drive, 0.0, 11, 0.0);
  for (std::size_t i = 0; i < frames.size(); ++i) {  // the same view and a resting IMU all the time
    frames[i].features.features = frames[0].features.features;
    if (!frames[i].imu) continue;
    auto samples = frames[i].imu->samples();
    for (ImuSample& sample : samples) {
      sample.angular_velocity_B.setZero();
      sample.acceleration_B = {0.0, 0.0, 9.81};
    }
    frames[i].imu.emplace(samples, ImuBias(), drive.noise);
  }
  const auto outcome = initialise(frames, drive.T_BS(), {}, {}).outcome;
  EXPECT_TRUE(outcome == InitialisationOutcome::kTooLittleParallax ||
              outcome == InitialisationOutcome::kNoSolution)
      << to_string(outcome);
}

TEST(AdaptiveVins, StartsColdTracksAndStartsAgainAfterAFailure) {
  SyntheticDrive drive(3);
  VinsOptions options;
  options.initialisation = calibrated();
  AdaptiveVins vins(options, drive.T_BS());
  for (const ImuSample& sample : drive.imu(0.0, 12.0))
    vins.add_imu(sample);
  int first_tracked = -1;
  int restarts = 0;
  VinsEstimate estimate;
  for (int i = 0; i <= 110; ++i) {
    FeatureFrame frame = drive.camera(0.1 * i, 0.25);
    if (i >= 50 && i < 62) frame.features.clear();  // the lens is covered
    estimate = vins.process(frame);
    if (estimate.status == VinsStatus::kTracking && first_tracked < 0) first_tracked = i;
    restarts = estimate.restarts;
  }
  EXPECT_GE(first_tracked, 8);
  EXPECT_LE(first_tracked, 20);
  EXPECT_EQ(restarts, 1);
  EXPECT_EQ(estimate.status, VinsStatus::kTracking);
  ASSERT_TRUE(estimate.report);
  EXPECT_NEAR(estimate.report->state.v_W.norm(), drive.state(11.0).v_W.norm(), 0.1);
}

TEST(AdaptiveVins, LeavesOutFramesThatTheImuDoesNotCover) {
  SyntheticDrive drive(3);
  AdaptiveVins vins({}, drive.T_BS());
  EXPECT_EQ(vins.process(drive.camera(0.0, 0.25)).status, VinsStatus::kWaitingForImu);
}

}  // namespace
}  // namespace cosight::vins
