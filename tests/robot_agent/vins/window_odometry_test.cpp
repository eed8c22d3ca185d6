#include "robot_agent/vins/window_odometry.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

constexpr double kStart = 2.0;   ///< where a start hands over to the odometry, into the drive [s]
constexpr double kPeriod = 0.1;  ///< of the camera [s]

/// A window as an initialisation would give it: the one of an odometry that has gone on until kStart.
Window window_at_start(SyntheticDrive& drive) {
  WindowOptions options;
  options.solver.graph.trust.mode = TrustMode::kFixed;
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, 0.25), drive.state(0.0), {});
  for (double t = kPeriod; t < kStart + 0.5 * kPeriod; t += kPeriod)
    odometry.process(drive.camera(t, 0.25), drive.imu(t - kPeriod, t));
  return odometry.window();
}

/// A guard that acts with any noise: a tenth of the usual misfit is too much, and one in a hundred is many.
WindowOptions hasty_guard(double settling_time, double learning_time = 0.0) {
  WindowOptions options;
  options.learning_time = learning_time;
  options.settling_time = settling_time;
  options.solver.graph.trust.mode = TrustMode::kGuarded;
  options.solver.graph.trust.misfit_width = 0.1;
  options.solver.graph.trust.many_bend_on = 0.01;
  options.solver.graph.trust.many_bend_off = 0.005;
  return options;
}

/// Whether the guard acted in each of the `count` frames that follow `from`.
std::vector<bool> acted(WindowOdometry& odometry, SyntheticDrive& drive, double from, int count) {
  std::vector<bool> acts;
  for (int i = 1; i <= count; ++i) {
    const double t = from + kPeriod * i;
    acts.push_back(odometry.process(drive.camera(t, 0.25), drive.imu(t - kPeriod, t)).many_bend);
  }
  return acts;
}

std::vector<bool> acted_after_start_from_nothing(const WindowOptions& options, int count,
                                                 bool is_sure = false) {
  SyntheticDrive drive(6);
  Window window = window_at_start(drive);
  EXPECT_FALSE(window.many_bend);
  WindowOdometry odometry(options, drive.noise, drive.T_BS());
  odometry.start(std::move(window), is_sure);
  return acted(odometry, drive, kStart, count);
}

TEST(SettlingTime, OfZeroLetsTheGuardActAtOnce) {
  EXPECT_EQ(acted_after_start_from_nothing(hasty_guard(0.0), 3), std::vector<bool>({true, true, true}));
}

TEST(SettlingTime, OfHalfAMinuteKeepsTheGuardAtRestForASecondAtLeast) {
  EXPECT_EQ(acted_after_start_from_nothing(hasty_guard(30.0), 10), std::vector<bool>(10, false));
}

TEST(SettlingTime, IsNotNeededAfterAStartThatIsSure) {
  EXPECT_EQ(acted_after_start_from_nothing(hasty_guard(30.0), 3, true),
            std::vector<bool>({true, true, true}));
}

TEST(LearningTime, KeepsTheGuardAtRestAfterASureStartToo) {
  EXPECT_EQ(acted_after_start_from_nothing(hasty_guard(0.0, 0.35), 5, true),
            std::vector<bool>({false, false, false, true, true}));
}

TEST(SettlingTime, EndsWithTheFirstFrameBehindIt) {
  EXPECT_EQ(acted_after_start_from_nothing(hasty_guard(0.35), 6),
            std::vector<bool>({false, false, false, true, true, true}));
}

TEST(SettlingTime, BeginsAnewWithEachStart) {
  SyntheticDrive drive(6);
  const Window window = window_at_start(drive);
  WindowOdometry odometry(hasty_guard(0.35), drive.noise, drive.T_BS());
  for (int start = 0; start < 2; ++start) {
    odometry.start(window);
    EXPECT_EQ(acted(odometry, drive, kStart, 4), std::vector<bool>({false, false, false, true}));
  }
}

/// The first state is known there, so that what bends does move.
TEST(SettlingTime, IsNotNeededWithAKnownFirstState) {
  SyntheticDrive drive(6);
  WindowOdometry odometry(hasty_guard(30.0), drive.noise, drive.T_BS());
  odometry.start(drive.camera(0.0, 0.25), drive.state(0.0), {});
  EXPECT_TRUE(acted(odometry, drive, 0.0, 10).back());
}

}  // namespace
}  // namespace cosight::vins
