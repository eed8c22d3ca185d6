#include "robot_agent/vins/failure.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <set>
#include <string>

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

constexpr double kNan = std::numeric_limits<double>::quiet_NaN();

/// Limits of their own, so that a test says both sides of each.
FailureOptions limits() {
  return {.min_tracked = 10,
          .max_accelerometer_bias = 2.0,
          .max_gyroscope_bias = 0.5,
          .max_speed = 30.0,
          .max_position_jump = 4.0,
          .max_rotation_jump = 0.2};
}

/// A drive at 20 m/s, 300 m from where it began, as the IMU predicted it but for what a camera corrects.
WindowReport good_report() {
  WindowReport report;
  report.solve.usable = true;
  report.tracked = 80;
  report.state.T_WB = {Eigen::Quaterniond(Eigen::AngleAxisd(2.5, Vector3d::UnitZ())), {300.0, -40.0, 2.0}};
  report.state.v_W = {12.0, 16.0, 0.0};
  report.state.bias = {{0.1, -0.2, 0.05}, {0.01, 0.0, -0.02}};
  report.predicted = report.state;
  report.predicted.T_WB.p += Vector3d(0.02, -0.01, 0.01);
  report.predicted.T_WB.q = report.state.T_WB.q * Eigen::AngleAxisd(0.002, Vector3d::UnitX());
  return report;
}

/// The report turned against its prediction by an angle [rad].
WindowReport turned_by(double angle) {
  WindowReport report = good_report();
  const Vector3d axis = Vector3d(1.0, -2.0, 2.0) / 3.0;
  report.state.T_WB.q = report.predicted.T_WB.q * Eigen::AngleAxisd(angle, axis);
  return report;
}

TEST(DetectFailure, BelievesAReportThatFitsItsPrediction) {
  EXPECT_EQ(detect_failure(good_report(), limits()), Failure::kNone);
  EXPECT_EQ(detect_failure(good_report(), {}), Failure::kNone);
}

TEST(DetectFailure, NeedsASolution) {
  WindowReport report = good_report();
  report.solve.usable = false;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kSolverFailed);
}

TEST(DetectFailure, NeedsTheFewestTracksAllowedAndNotOneLess) {
  WindowReport report = good_report();
  report.tracked = 10;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report.tracked = 9;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kLostTracks);
}

TEST(DetectFailure, TakesTheLengthOfEachBiasWhateverItsDirection) {
  const Vector3d direction = Vector3d(2.0, -1.0, -2.0) / 3.0;
  WindowReport report = good_report();
  report.state.bias.accelerometer = 1.99 * direction;
  report.state.bias.gyroscope = -0.49 * direction;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report.state.bias.accelerometer = 2.01 * direction;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kImpossibleBias);
  report.state.bias.accelerometer.setZero();
  report.state.bias.gyroscope = -0.51 * direction;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kImpossibleBias);
}

TEST(DetectFailure, TakesTheSpeedWhateverItsDirection) {
  WindowReport report = good_report();
  report.state.v_W = {0.0, -29.9 * 0.6, -29.9 * 0.8};
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report.state.v_W = {0.0, -30.1 * 0.6, -30.1 * 0.8};
  EXPECT_EQ(detect_failure(report, limits()), Failure::kTooFast);
}

TEST(DetectFailure, BelievesOthersDistancesWhereSeveralContradictTheScale) {
  WindowReport report = good_report();
  report.distances = {.count = 12, .ratio = 1.2};
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report.distances.ratio = 2.0;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kWrongScale);
  report.distances.ratio = 0.5;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kWrongScale);
}

TEST(DetectFailure, FindsAJumpAgainstThePrediction) {
  WindowReport report = good_report();
  report.state.T_WB.p = report.predicted.T_WB.p + 3.99 * Vector3d(0.6, 0.0, -0.8);
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report.state.T_WB.p = report.predicted.T_WB.p + 4.01 * Vector3d(0.6, 0.0, -0.8);
  EXPECT_EQ(detect_failure(report, limits()), Failure::kJumped);
}

TEST(DetectFailure, FindsATurnAgainstThePrediction) {
  EXPECT_EQ(detect_failure(turned_by(0.199), limits()), Failure::kNone);
  EXPECT_EQ(detect_failure(turned_by(-0.199), limits()), Failure::kNone);
  EXPECT_EQ(detect_failure(turned_by(0.201), limits()), Failure::kJumped);
  EXPECT_EQ(detect_failure(turned_by(-0.201), limits()), Failure::kJumped);
}

TEST(DetectFailure, TakesBothQuaternionsOfAnOrientationAlike) {
  WindowReport report = turned_by(0.199);
  report.state.T_WB.q.coeffs() *= -1.0;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
  report = turned_by(0.201);
  report.state.T_WB.q.coeffs() *= -1.0;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kJumped);
}

/// A comparison with NaN is false on both sides of a limit.
TEST(DetectFailure, BelievesNoStateThatIsNotANumber) {
  for (int axis = 0; axis < 3; ++axis) {
    WindowReport report = good_report();
    report.state.T_WB.p(axis) = kNan;
    EXPECT_EQ(detect_failure(report, limits()), Failure::kSolverFailed) << "position " << axis;
    report = good_report();
    report.state.bias.accelerometer(axis) = kNan;
    EXPECT_EQ(detect_failure(report, limits()), Failure::kImpossibleBias) << "accelerometer " << axis;
    report = good_report();
    report.state.bias.gyroscope(axis) = kNan;
    EXPECT_EQ(detect_failure(report, limits()), Failure::kImpossibleBias) << "gyroscope " << axis;
    report = good_report();
    report.state.v_W(axis) = kNan;
    EXPECT_EQ(detect_failure(report, limits()), Failure::kTooFast) << "velocity " << axis;
  }
  for (int part = 0; part < 4; ++part) {
    WindowReport report = good_report();
    report.state.T_WB.q.coeffs()(part) = kNan;
    EXPECT_EQ(detect_failure(report, limits()), Failure::kSolverFailed) << "orientation " << part;
  }
}

TEST(DetectFailure, BelievesNoStateThatIsInfinite) {
  WindowReport report = good_report();
  report.state.T_WB.p.y() = -std::numeric_limits<double>::infinity();
  EXPECT_EQ(detect_failure(report, limits()), Failure::kSolverFailed);
  report = good_report();
  report.state.v_W.z() = std::numeric_limits<double>::infinity();
  EXPECT_EQ(detect_failure(report, limits()), Failure::kTooFast);
}

TEST(DetectFailure, BelievesNothingBesideAPredictionThatIsNotANumber) {
  WindowReport report = good_report();
  report.predicted.T_WB.p.x() = kNan;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kJumped);
  report = good_report();
  report.predicted.T_WB.q.w() = kNan;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kJumped);
}

/// Everything is wrong; one after the other is put right.
TEST(DetectFailure, NamesWhatComesFirstOfSeveral) {
  const WindowReport good = good_report();
  WindowReport report = good;
  report.solve.usable = false;
  report.tracked = 0;
  report.state.bias.gyroscope.x() = 9.0;
  report.state.v_W.x() = 900.0;
  report.distances = {.count = 12, .ratio = 9.0};
  report.state.T_WB.p.x() += 90.0;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kSolverFailed);
  report.solve.usable = true;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kLostTracks);
  report.tracked = good.tracked;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kImpossibleBias);
  report.state.bias = good.state.bias;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kTooFast);
  report.state.v_W = good.state.v_W;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kWrongScale);
  report.distances = good.distances;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kJumped);
  report.state.T_WB = good.state.T_WB;
  EXPECT_EQ(detect_failure(report, limits()), Failure::kNone);
}

TEST(Failure, HasANameOfItsOwnForEachKind) {
  using enum Failure;
  std::set<std::string> names;
  for (const Failure failure :
       {kNone, kSolverFailed, kLostTracks, kImpossibleBias, kImuGap, kTooFast, kJumped})
    names.insert(to_string(failure));
  EXPECT_EQ(names.size(), 7U);
}

}  // namespace
}  // namespace cosight::vins
