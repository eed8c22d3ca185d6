#include "robot_agent/wearer_locator.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <vector>

#include "tests/robot_agent/standing_person.hpp"

namespace cosight::robot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Stamp ms(std::int64_t milliseconds) {
  return milliseconds * 1'000'000;
}

AhrsSample head(Stamp stamp) {
  return {.stamp = stamp,
          .q_WH = Eigen::Quaterniond::Identity(),
          .orientation_covariance = 1e-4 * Eigen::Matrix3d::Identity(),
          .angular_velocity_H = Eigen::Vector3d::Zero(),
          .acceleration_H = Eigen::Vector3d::Zero()};
}

FrameEstimate robot_seen(Stamp stamp, double yaw_offset) {
  FrameEstimate estimate;
  estimate.stamp = stamp;
  estimate.tracking = Tracking::kTracking;
  estimate.T_WS.T.q = wearer::HeadOptions{}.T_BS.q;  // it looks along the map's x axis
  estimate.T_WS.covariance = 1e-6 * Eigen::Matrix<double, 6, 6>::Identity();
  estimate.yaw_offset = yaw_offset;
  estimate.yaw_offset_sigma = 0.01;
  return estimate;
}

class WearerLocatorTest : public testing::Test {
 protected:
  void odometry(Stamp stamp) { locator_.add(WheelOdometrySample{.stamp = stamp}); }
  void orientation(Stamp stamp) { locator_.add(head(stamp)); }
  void scan(Stamp stamp, const char* laser = "laser_front") {
    LaserScanSample sample = scan_of_person(stamp);
    sample.laser = laser;
    locator_.add(std::move(sample));
  }

  std::vector<Stamp> used_;
  std::optional<WearerPoseSample> pose_;
  WearerLocator locator_{{}, {}, [this](Stamp stamp, const std::optional<WearerPoseSample>& pose) {
                           used_.push_back(stamp);
                           if (pose) pose_ = pose;
                         }};
};

TEST_F(WearerLocatorTest, AScanWaitsForTheOdometryOfItsTime) {
  odometry(ms(0));
  scan(ms(30));
  EXPECT_THAT(used_, IsEmpty());
  odometry(ms(20));
  EXPECT_THAT(used_, IsEmpty());
  odometry(ms(40));
  EXPECT_THAT(used_, ElementsAre(ms(30)));
}

TEST_F(WearerLocatorTest, ScansOfBothLasersAreUsedInTheOrderOfTheirStamps) {
  odometry(ms(80));
  scan(ms(0), "laser_rear");
  scan(ms(30), "laser_front");
  EXPECT_THAT(used_, ElementsAre(ms(0)));
  scan(ms(10), "laser_rear");
  EXPECT_THAT(used_, ElementsAre(ms(0), ms(10)));
  scan(ms(50), "laser_rear");
  EXPECT_THAT(used_, ElementsAre(ms(0), ms(10), ms(30)));
}

TEST_F(WearerLocatorTest, WhatBothLasersSawAtOneTimeIsSaidOnceWhicheverCameFirst) {
  const auto walk = [](bool rear_first) {
    std::vector<Eigen::Vector3d> positions;
    std::vector<Stamp> stamps;
    WearerLocator locator({}, {}, [&](Stamp stamp, const std::optional<WearerPoseSample>& pose) {
      stamps.push_back(stamp);
      if (pose) positions.push_back(pose->T_SF.T.p);
    });
    LaserScanSample rear = scan_of_person(0);
    rear.laser = "laser_rear";
    for (rear.stamp = 0; rear.stamp < ms(1600); rear.stamp += ms(40)) {
      if (rear_first) locator.add(rear);
      locator.add(scan_of_person(rear.stamp));
      if (!rear_first) locator.add(rear);
      locator.add(WheelOdometrySample{.stamp = rear.stamp});
    }
    EXPECT_EQ(stamps.size(), 40U);
    return positions;
  };
  EXPECT_FALSE(walk(true).empty());
  EXPECT_EQ(walk(true), walk(false));
}

TEST_F(WearerLocatorTest, OdometryThatStaysAwayIsNotWaitedForLong) {
  scan(ms(0));
  scan(ms(40));
  scan(ms(80));
  EXPECT_THAT(used_, IsEmpty());
  scan(ms(120));
  EXPECT_THAT(used_, ElementsAre(ms(0)));
  locator_.finish();
  EXPECT_THAT(used_, ElementsAre(ms(0), ms(40), ms(80), ms(120)));
}

TEST_F(WearerLocatorTest, AScanWaitsForTheOrientationOfItsTime) {
  orientation(ms(0));
  odometry(ms(40));
  scan(ms(30));
  EXPECT_THAT(used_, IsEmpty());
  orientation(ms(40));
  EXPECT_THAT(used_, ElementsAre(ms(30)));
}

TEST_F(WearerLocatorTest, AnAhrsThatFellSilentIsNotWaitedFor) {
  orientation(ms(0));
  odometry(ms(300));
  scan(ms(90));
  EXPECT_THAT(used_, IsEmpty());
  scan(ms(200));
  EXPECT_THAT(used_, ElementsAre(ms(90), ms(200)));
}

TEST_F(WearerLocatorTest, HowFastAFrameIsProcessedDoesNotMatterWithinTheDelay) {
  const auto walk = [](Stamp processing) {
    std::vector<Eigen::Vector3d> positions;
    WearerLocator locator({}, {}, [&](Stamp, const std::optional<WearerPoseSample>& pose) {
      if (pose) positions.push_back(pose->T_SF.T.p);
    });
    for (Stamp now = 0; now < ms(2000); now += ms(10)) {
      if (now % ms(100) == processing)
        locator.add(robot_seen(now - processing, to_seconds(now - processing)));
      locator.add(head(now));
      locator.add(WheelOdometrySample{.stamp = now});
      if (now % ms(40) == 0) locator.add(scan_of_person(now));
    }
    EXPECT_EQ(locator.estimates_late(), 0U);
    return positions;
  };
  const auto quick = walk(ms(0));
  EXPECT_GT(quick.size(), 20U);
  EXPECT_EQ(quick, walk(ms(90)));
}

TEST_F(WearerLocatorTest, AnEstimateThatIsTooLateIsCounted) {
  for (int i = 0; i < 20; ++i) {
    odometry(ms(40 * i));
    scan(ms(40 * i));
  }
  locator_.add(robot_seen(ms(600), 0.0));
  EXPECT_EQ(locator_.estimates_late(), 0U);
  locator_.add(robot_seen(ms(500), 0.0));
  EXPECT_EQ(locator_.estimates_late(), 1U);
}

TEST_F(WearerLocatorTest, APersonAheadIsFoundInTheSlamCamera) {
  for (int i = 0; i < 40; ++i) {
    odometry(ms(40 * i));
    scan(ms(40 * i));
  }
  ASSERT_TRUE(pose_);
  EXPECT_FALSE(pose_->has_orientation);
  // The laser 0.2 m ahead of the body, the camera 0.1 m ahead at 0.85 m; the head 1.65 m above the floor.
  EXPECT_NEAR(pose_->T_SF.T.p.z(), 1.5 + 0.2 - 0.1, 0.1);
  EXPECT_NEAR(pose_->T_SF.T.p.x(), 0.0, 0.05);
  EXPECT_NEAR(pose_->T_SF.T.p.y(), -(1.65 - 0.85), 0.1);
}

TEST_F(WearerLocatorTest, TheCameraIsWhereTheAhrsAndItsYawOffsetTurnTheHead) {
  const auto look = [this](Stamp from, double yaw_offset) {
    for (int i = 0; i < 25; ++i) {
      const Stamp stamp = from + ms(40 * i);
      locator_.add(robot_seen(stamp, yaw_offset));
      orientation(stamp);
      odometry(stamp);
      scan(stamp);
    }
    return pose_.value_or(WearerPoseSample{}).T_SF.T.p;
  };
  const Eigen::Vector3d ahead = look(ms(0), 0.0);
  const Eigen::Vector3d to_the_left = look(ms(1000), std::acos(0.0));
  const double reach = wearer::HeadOptions{}.p_HF.x();  // of the camera from the head's axis
  EXPECT_NEAR(to_the_left.x() - ahead.x(), -reach, 0.03);
  EXPECT_NEAR(to_the_left.z() - ahead.z(), -reach, 0.03);
}

}  // namespace
}  // namespace cosight::robot
