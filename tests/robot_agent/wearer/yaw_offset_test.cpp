#include "robot_agent/wearer/yaw_offset.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <random>

namespace cosight::wearer {
namespace {

constexpr double kPi = std::numbers::pi;

Eigen::Quaterniond turned(double yaw, double pitch = 0.0) {
  return Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ()) *
                            Eigen::AngleAxisd(pitch, Eigen::Vector3d::UnitY()));
}

double difference(double a, double b) {
  return std::remainder(a - b, 2.0 * kPi);
}

/// A head that looks about, an AHRS whose north is off by an angle that walks randomly, and a camera that
/// sees where it looks.
class Sky {
 public:
  Sky(unsigned seed, double yaw) : yaw_WA(yaw), random_(seed) {}

  void pass(double seconds, double drift) {
    time_ += seconds;
    yaw_WA += drift * std::sqrt(seconds) * draw();
    gaze_W = direction_W + 0.6 * std::sin(1.7 * time_) + 0.3 * draw();
  }
  Stamp stamp() const { return from_seconds(time_); }
  double draw() { return normal_(random_); }

  Eigen::Quaterniond q_AH(double sigma = 0.0) { return turned(gaze_W - yaw_WA + sigma * draw(), 0.1); }
  Eigen::Quaterniond q_WH(double sigma = 0.0) { return turned(gaze_W + sigma * draw(), 0.1); }

  double yaw_WA;
  double direction_W = 0.4;
  double gaze_W = 0.0;

 private:
  std::mt19937 random_;
  std::normal_distribution<double> normal_;
  double time_ = 0.0;
};

struct Consistency {
  double mean_nis = 0.0;
  double mean_nees = 0.0;
};

Consistency run_sightings(double claimed) {
  constexpr int kRuns = 40;
  constexpr int kSteps = 100;
  constexpr double kSeen = 0.02;
  Consistency result;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    YawOffsetOptions options;
    Sky sky(seed, 0.0);
    sky.yaw_WA = 0.3 * sky.draw();
    options.prior = {0.0, 0.3};
    YawOffset offset(options);
    for (int step = 0; step < kSteps; ++step) {
      sky.pass(0.5, options.drift);
      const Eigen::Matrix3d covariance = claimed * kSeen * kSeen * Eigen::Matrix3d::Identity();
      const YawReport report =
          offset.sighting(sky.stamp(), sky.q_WH(kSeen), covariance, sky.q_AH(options.ahrs_sigma));
      const double error = difference(offset.yaw_WA().angle, sky.yaw_WA);
      result.mean_nis += report.nis / (kRuns * kSteps);
      result.mean_nees += error * error / std::pow(offset.yaw_WA().sigma, 2) / (kRuns * kSteps);
    }
  }
  return result;
}

TEST(YawOffset, HasInnovationsAndErrorsAsLargeAsItSays) {
  const Consistency consistency = run_sightings(1.0);
  // 4000 samples of chi squared with one dof: 1 +- 0.022 if they were independent.
  EXPECT_NEAR(consistency.mean_nis, 1.0, 0.07);
  EXPECT_NEAR(consistency.mean_nees, 1.0, 0.2);
}

TEST(YawOffset, IsCaughtWhenItTrustsTheSightingsTooMuch) {
  const Consistency consistency = run_sightings(0.2);
  EXPECT_GT(consistency.mean_nis, 1.3);
  EXPECT_GT(consistency.mean_nees, 1.5);
}

TEST(YawOffset, ConvergesAcrossTheHalfTurn) {
  YawOffset offset({.prior = {3.1, 0.3}});
  const Eigen::Matrix3d covariance = 1e-4 * Eigen::Matrix3d::Identity();
  for (int step = 1; step <= 20; ++step)
    offset.sighting(from_seconds(0.1 * step), turned(-3.1 + 0.7), covariance, turned(0.7));
  EXPECT_NEAR(difference(offset.yaw_WA().angle, -3.1), 0.0, 0.01);
}

TEST(YawOffset, TakesNoTiltForATurn) {
  YawOffset offset({.prior = {0.0, 0.3}});
  const Eigen::Quaterniond tilt(Eigen::AngleAxisd(0.05, Eigen::Vector3d::UnitY()));
  const Eigen::Quaterniond q_AF = turned(0.4);
  const YawReport report =
      offset.sighting(from_seconds(1.0), tilt * turned(0.2) * q_AF, 1e-4 * Eigen::Matrix3d::Identity(), q_AF);
  EXPECT_NEAR(report.innovation, 0.2, 1e-3);
}

TEST(YawOffset, GatesOneWrongSightingButFollowsManyAlike) {
  YawOffset offset({.prior = {0.1, 0.02}});
  const Eigen::Matrix3d covariance = 1e-4 * Eigen::Matrix3d::Identity();
  EXPECT_EQ(offset.sighting(from_seconds(1.0), turned(0.8), covariance, turned(0.0)).outcome,
            YawReport::Outcome::kGated);
  EXPECT_EQ(offset.yaw_WA().angle, 0.1);
  for (int step = 0; step < 20; ++step)
    offset.sighting(from_seconds(1.1 + 0.1 * step), turned(0.8), covariance, turned(0.0));
  EXPECT_NEAR(offset.yaw_WA().angle, 0.8, 0.02);
}

TEST(YawOffset, KnowsLessTheLongerNobodyTellsIt) {
  YawOffset offset({.prior = {0.0, 0.3}});
  offset.sighting(from_seconds(1.0), turned(0.0), 1e-4 * Eigen::Matrix3d::Identity(), turned(0.0));
  EXPECT_GT(offset.yaw_WA(from_seconds(31.0)).sigma, 2.0 * offset.yaw_WA().sigma);
  EXPECT_LT(offset.yaw_WA(from_seconds(1e7)).sigma, 1.82);
}

TEST(YawOffset, IgnoresWhatIsNoNumber) {
  YawOffset offset({.prior = {0.2, 0.3}});
  const double nan = std::nan("");
  offset.sighting(from_seconds(1.0), turned(nan), Eigen::Matrix3d::Identity(), turned(0.0));
  offset.sighting(from_seconds(1.0), turned(0.0), nan * Eigen::Matrix3d::Identity(), turned(0.0));
  EXPECT_EQ(offset.yaw_WA().angle, 0.2);
  EXPECT_NEAR(offset.yaw_WA().sigma, 0.3, 1e-12);
}

}  // namespace
}  // namespace cosight::wearer
