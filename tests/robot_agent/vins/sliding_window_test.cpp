#include "robot_agent/vins/sliding_window.hpp"

#include <gtest/gtest.h>

#include "robot_agent/vins/window_odometry.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

/// The odometry over `seconds` of a drive at 10 Hz from the true first state; the last report.
WindowReport run(SyntheticDrive& drive, const WindowOptions& options, double seconds, double pixel_noise) {
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, pixel_noise), drive.state(0.0), {});
  WindowReport report;
  for (int i = 1; i <= static_cast<int>(10.0 * seconds); ++i) {
    const double t = 0.1 * i;
    report = odometry.process(drive.camera(t, pixel_noise), drive.imu(t - 0.1, t));
  }
  return report;
}

WindowOptions fixed_mode() {
  WindowOptions options;
  options.solver.graph.trust.mode = TrustMode::kFixed;
  options.solver.graph.trust.pixel_noise = 0.5;
  return options;
}

TEST(WindowOdometry, FollowsAPerfectDriveForTenSeconds) {
  SyntheticDrive drive(1);
  drive.noisy = false;
  const WindowReport last = run(drive, fixed_mode(), 10.0, 0.0);
  EXPECT_LT((last.state.T_WB.p - drive.state(10.0).T_WB.p).norm(), 5e-3);
  EXPECT_LT((last.state.v_W - drive.state(10.0).v_W).norm(), 5e-3);
}

TEST(WindowOdometry, StaysWithinAFewCentimetresWithNoiseAndFindsTheGyroscopesBias) {
  SyntheticDrive drive(2);
  drive.bias.gyroscope = {0.004, -0.003, 0.002};
  WindowOdometry odometry(fixed_mode(), drive.noise, drive.T_BS());
  NavState start = drive.state(0.0);
  start.bias = {};
  odometry.start(drive.camera(0.0, 0.25), start, {});
  WindowReport last;
  for (int i = 1; i <= 100; ++i)
    last = odometry.process(drive.camera(0.1 * i, 0.25), drive.imu(0.1 * i - 0.1, 0.1 * i));
  EXPECT_LT((last.state.T_WB.p - drive.state(10.0).T_WB.p).norm(), 0.1);
  EXPECT_LT((last.state.bias.gyroscope - drive.bias.gyroscope).norm(), 1e-3);
}

TEST(WindowOdometry, NeverHoldsMoreFramesThanItsWindow) {
  SyntheticDrive drive(3);
  WindowOptions options = fixed_mode();
  options.size = 6;
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, 0.25), drive.state(0.0), {});
  for (int i = 1; i <= 20; ++i) {
    odometry.process(drive.camera(0.1 * i, 0.25), drive.imu(0.1 * i - 0.1, 0.1 * i));
    EXPECT_LT(odometry.window().frames.size(), options.size);
  }
}

TEST(WindowOdometry, KeepsItsImuWhenTheSecondNewestFrameIsDropped) {
  SyntheticDrive drive(4);
  WindowOptions options = fixed_mode();
  options.keyframe.min_parallax = 10.0;  // no frame ever is a keyframe
  options.keyframe.min_tracked = 0;
  const WindowReport last = run(drive, options, 5.0, 0.25);
  EXPECT_FALSE(last.keyframe);
  EXPECT_LT((last.state.T_WB.p - drive.state(5.0).T_WB.p).norm(), 0.1);
}

/// What went into the prior with the oldest frame is gone from the window; nothing else is.
TEST(Slide, LeavesNoSightingThatThePriorHasUsed) {
  SyntheticDrive drive(5);
  WindowOptions options = fixed_mode();
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, 0.25), drive.state(0.0), {});
  for (int i = 1; i < 10; ++i)
    odometry.process(drive.camera(0.1 * i, 0.25), drive.imu(0.1 * i - 0.1, 0.1 * i));
  Window window = odometry.window();
  const FrameId oldest = window.frames.front().id;
  const FrameId newest = window.frames.back().id;
  int handed_over = 0;
  const auto before = window.landmarks;
  slide(window, true, options);
  for (const auto& [id, landmark] : before) {
    const std::size_t count = landmark.observations.size();
    const bool spans_all =
        landmark.observations.front().frame == oldest && landmark.observations.back().frame == newest;
    if (!spans_all || count < 4) continue;
    const auto after = window.landmarks.find(id);
    ASSERT_NE(after, window.landmarks.end()) << "it is still followed";
    EXPECT_LE(after->second.observations.size() + 2, count);
    EXPECT_EQ(after->second.observations.back().frame, landmark.observations.back().frame);
    ++handed_over;
  }
  EXPECT_GT(handed_over, 10);
}

TEST(DropFailedLandmarks, KeepsFarPointsWhoseNoiseIsNegative) {
  Window window;
  window.frames.push_back({});
  window.landmarks[1] = {.observations = {{0, {}, 1}}, .lambda = -0.001, .has_depth = true};
  window.landmarks[2] = {.observations = {{0, {}, 1}}, .lambda = -1.0, .has_depth = true};
  EXPECT_EQ(drop_failed_landmarks(window, {}), 1);
  EXPECT_TRUE(window.landmarks.at(1).has_depth);
  EXPECT_FALSE(window.landmarks.at(2).has_depth);
}

}  // namespace
}  // namespace cosight::vins
