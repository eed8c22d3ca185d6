#include "robot_agent/inbox/interpolation.hpp"

#include <gtest/gtest.h>

#include "shared/geometry/rotation.hpp"

namespace cosight::inbox {
namespace {

constexpr Stamp ms(std::int64_t milliseconds) {
  return from_milliseconds(milliseconds);
}

WearerPoseSample pose_at(Stamp stamp, const Eigen::Vector3d& p, const Eigen::Vector3d& rotation,
                         double variance) {
  WearerPoseSample sample;
  sample.stamp = stamp;
  sample.T_SF.T = {quaternion_exp(rotation), p};
  sample.T_SF.covariance = variance * Eigen::Matrix<double, 6, 6>::Identity();
  return sample;
}

TEST(InterpolatedPose, ASampleAtTheStampIsTakenAsItIs) {
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {1, 2, 3}, {0.1, 0.2, 0.3}, 0.01));
  poses.insert(pose_at(ms(20), {2, 2, 3}, {0.1, 0.2, 0.4}, 0.02));
  const auto pose = interpolate_pose(poses, ms(20), {});
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->T_SF.T.p, Eigen::Vector3d(2, 2, 3));
  EXPECT_TRUE(pose->T_SF.covariance.isApprox(0.02 * Eigen::Matrix<double, 6, 6>::Identity(), 1e-15));
}

TEST(InterpolatedPose, LiesOnTheWayOfAConstantTurn) {
  StampedHistory<WearerPoseSample> poses(10);
  const Eigen::Vector3d axis = Eigen::Vector3d(1, 2, -1).normalized();
  poses.insert(pose_at(ms(0), {0, 0, 0}, 0.2 * axis, 0.01));
  poses.insert(pose_at(ms(40), {4, -4, 8}, 0.6 * axis, 0.03));
  const auto pose = interpolate_pose(poses, ms(10), {});
  ASSERT_TRUE(pose);
  EXPECT_TRUE(pose->T_SF.T.p.isApprox(Eigen::Vector3d(1, -1, 2)));
  EXPECT_LT(pose->T_SF.T.q.angularDistance(quaternion_exp(0.3 * axis)), 1e-12);
  EXPECT_EQ(pose->stamp, ms(10));
}

TEST(InterpolatedPose, WhatCameAfterTheStreamHadPassedMakesNoDifference) {
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {1, 0, 0}, {0, 0, 0}, 0.01));
  poses.pass(ms(40));
  EXPECT_EQ(interpolate_pose(poses, ms(30), {}).value().T_SF.T.p.x(), 1.0);
  poses.insert(pose_at(ms(80), {2, 0, 0}, {0, 0, 0}, 0.01));
  EXPECT_EQ(interpolate_pose(poses, ms(30), {}).value().T_SF.T.p.x(), 1.0);
  EXPECT_EQ(interpolate_pose(poses, ms(70), {}).value().T_SF.T.p.x(), 2.0);
}

TEST(InterpolatedPose, CovarianceBoundsEveryCorrelationOfTheTwoErrors) {
  const double variance_a = 0.01;
  const double variance_b = 0.03;
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {0, 0, 0}, {0, 0, 0}, variance_a));
  poses.insert(pose_at(ms(40), {1, 0, 0}, {0, 0, 0}, variance_b));
  const auto pose = interpolate_pose(poses, ms(10), {});
  ASSERT_TRUE(pose);
  const double fully_correlated = std::pow(0.75 * std::sqrt(variance_a) + 0.25 * std::sqrt(variance_b), 2);
  EXPECT_GE(pose->T_SF.covariance(0, 0), fully_correlated);
  EXPECT_LT(pose->T_SF.covariance(0, 0), variance_b);
}

TEST(InterpolatedPose, CovarianceHoldsTheBendThatSamplesDoNotShow) {
  // A wearer that accelerates by 2 m/s^2: x = t^2, seen at 0 and 100 ms, asked at 50 ms.
  InterpolationOptions options;
  options.acceleration = 2.0;
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {0, 0, 0}, {0, 0, 0}, 0.0));
  poses.insert(pose_at(ms(100), {0.01, 0, 0}, {0, 0, 0}, 0.0));
  const auto pose = interpolate_pose(poses, ms(50), options);
  ASSERT_TRUE(pose);
  const double error = pose->T_SF.T.p.x() - 0.05 * 0.05;
  EXPECT_NEAR(std::sqrt(pose->T_SF.covariance(0, 0)), std::abs(error), 1e-12);
}

TEST(InterpolatedPose, BeyondTheLastSampleTheCovarianceGrowsWithTime) {
  InterpolationOptions options;
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {1, 0, 0}, {0, 0, 0}, 1e-4));
  const auto pose = interpolate_pose(poses, ms(30), options);
  ASSERT_TRUE(pose);
  EXPECT_EQ(pose->T_SF.T.p.x(), 1.0);
  EXPECT_NEAR(pose->T_SF.covariance(1, 1), 1e-4 + std::pow(options.speed * 0.03, 2), 1e-15);
  EXPECT_NEAR(pose->T_SF.covariance(4, 4), 1e-4 + std::pow(options.turn_rate * 0.03, 2), 1e-15);
  EXPECT_FALSE(interpolate_pose(poses, ms(61), options));
}

TEST(InterpolatedPose, AFarNeighbourIsNotPartOfIt) {
  StampedHistory<WearerPoseSample> poses(10);
  poses.insert(pose_at(ms(0), {1, 0, 0}, {0, 0, 0}, 1e-4));
  poses.insert(pose_at(ms(900), {9, 0, 0}, {0, 0, 0}, 1e-4));
  EXPECT_EQ(interpolate_pose(poses, ms(5), {})->T_SF.T.p.x(), 1.0);
  EXPECT_EQ(interpolate_pose(poses, ms(880), {})->T_SF.T.p.x(), 9.0);
  EXPECT_FALSE(interpolate_pose(poses, ms(450), {}));
}

TEST(InterpolatedPose, WithoutOrientationOnlyThePositionCounts) {
  StampedHistory<WearerPoseSample> poses(10);
  WearerPoseSample position_only = pose_at(ms(0), {1, 0, 0}, {0, 0, 0}, 0.01);
  position_only.has_orientation = false;
  position_only.T_SF.covariance.bottomRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  poses.insert(position_only);
  const auto pose = interpolate_pose(poses, ms(0), {});
  ASSERT_TRUE(pose);
  EXPECT_FALSE(pose->has_orientation);
  EXPECT_EQ(pose->T_SF.covariance(0, 0), 0.01);
  EXPECT_TRUE((pose->T_SF.covariance.bottomRightCorner<3, 3>().isZero()));
}

TEST(StampedHistoryTest, SortsReplacesAndForgetsTheOldest) {
  StampedHistory<WearerPoseSample> poses(3);
  for (const std::int64_t t : {30, 10, 20, 40}) {
    poses.insert(pose_at(ms(t), Eigen::Vector3d::Constant(static_cast<double>(t)), {0, 0, 0}, 1.0));
  }
  poses.insert(pose_at(ms(30), {-1, -1, -1}, {0, 0, 0}, 1.0));
  EXPECT_EQ(poses.size(), 3U);
  EXPECT_EQ(poses.neighbours(ms(15)).before, nullptr);
  EXPECT_EQ(poses.neighbours(ms(15)).after->stamp, ms(20));
  EXPECT_EQ(poses.neighbours(ms(30)).before->T_SF.T.p.x(), -1.0);
  EXPECT_EQ(poses.neighbours(ms(45)).after, nullptr);
}

TEST(FreeCameraOrientation, ALevelHeadTowardsXLooksAlongX) {
  const UncertainOrientation q_WF = free_camera_orientation({}, {.yaw_offset = 0.0});
  EXPECT_TRUE((q_WF.q * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitX()));   // forward
  EXPECT_TRUE((q_WF.q * Eigen::Vector3d::UnitY()).isApprox(-Eigen::Vector3d::UnitZ()));  // image down
  EXPECT_TRUE((q_WF.q * Eigen::Vector3d::UnitX()).isApprox(-Eigen::Vector3d::UnitY()));  // image right
}

TEST(FreeCameraOrientation, YawOffsetTurnsNorthToTheWorldsX) {
  constexpr double kQuarter = M_PI / 2;
  UncertainOrientation q_WH;
  q_WH.covariance = Eigen::Vector3d(1e-4, 4e-4, 9e-4).asDiagonal();
  const UncertainOrientation q_WF =
      free_camera_orientation(q_WH, {.mounting_sigma = 0.01, .yaw_offset = kQuarter});
  EXPECT_TRUE((q_WF.q * Eigen::Vector3d::UnitZ()).isApprox(Eigen::Vector3d::UnitY(), 1e-12));
  const Eigen::Vector3d expected(4e-4 + 1e-4, 1e-4 + 1e-4,
                                 9e-4 + 1e-4);  // what the offset leaves open is slam's
  EXPECT_TRUE(q_WF.covariance.diagonal().isApprox(expected, 1e-12));
}

TEST(InterpolatedOrientation, LiesBetweenItsNeighbours) {
  StampedHistory<AhrsSample> samples(10);
  AhrsSample sample;
  sample.orientation_covariance = 1e-4 * Eigen::Matrix3d::Identity();
  samples.insert(sample);
  sample.stamp = ms(10);
  sample.q_WH = quaternion_exp({0, 0, 0.1});
  samples.insert(sample);
  const auto q_WH = interpolate_orientation(samples, ms(4), {});
  ASSERT_TRUE(q_WH);
  EXPECT_LT(q_WH->q.angularDistance(quaternion_exp({0, 0, 0.04})), 1e-12);
  EXPECT_GE(q_WH->covariance(0, 0), 1e-4);
  EXPECT_FALSE(interpolate_orientation(samples, ms(100), {}));
}

TEST(InterpolatedOrientation, TakesTheShortWayBetweenOppositeSigns) {
  StampedHistory<AhrsSample> samples(10);
  AhrsSample sample;
  sample.q_WH = quaternion_exp({0, 0, 3.1});
  samples.insert(sample);
  sample.stamp = ms(10);
  sample.q_WH = quaternion_exp({0, 0, 3.2});
  sample.q_WH.coeffs() *= -1.0;
  samples.insert(sample);
  const auto q_WH = interpolate_orientation(samples, ms(5), {});
  ASSERT_TRUE(q_WH);
  EXPECT_LT(q_WH->q.angularDistance(quaternion_exp({0, 0, 3.15})), 1e-9);
}

}  // namespace
}  // namespace cosight::inbox
