#include "robot_agent/wearer/odometry_frame.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cosight::wearer {
namespace {

/// A circle of radius 1 m at 1 m/s that began somewhere else.
WheelOdometrySample on_circle(double time) {
  return {from_seconds(time), 5.0 + std::sin(time), -3.0 + 1.0 - std::cos(time), time, 1.0, 1.0};
}

TEST(OdometryFrame, BeginsWhereTheRobotIs) {
  OdometryFrame frame;
  frame.add({from_seconds(1.0), 7.0, 8.0, 1.5, 0.0, 0.0});
  EXPECT_NEAR(frame.T_OB(from_seconds(1.0)).p.norm(), 0.0, 1e-12);
  EXPECT_NEAR(frame.T_OB(from_seconds(1.0)).q.angularDistance(Eigen::Quaterniond::Identity()), 0.0, 1e-9);
}

TEST(OdometryFrame, IsRightBetweenItsSamplesAndALittleBeyond) {
  OdometryFrame frame;
  for (int k = 0; k <= 40; ++k)
    frame.add(on_circle(0.05 * k));
  for (const double time : {1.0, 1.523, 1.98, 2.05}) {
    const Pose T_OB = frame.T_OB(from_seconds(time));
    EXPECT_NEAR(T_OB.p.x(), std::sin(time), 1e-3) << time;
    EXPECT_NEAR(T_OB.p.y(), 1.0 - std::cos(time), 1e-3) << time;
  }
}

TEST(OdometryFrame, GoesOnWithoutAJumpWhenTheWheelsStartToCountAnew) {
  OdometryFrame frame;
  for (int k = 0; k <= 20; ++k)
    frame.add(on_circle(0.05 * k));
  const Pose before = frame.T_OB(from_seconds(1.05));
  frame.add({from_seconds(1.05), 0.0, 0.0, 0.0, 1.0, 1.0});
  EXPECT_EQ(frame.jumps(), 1U);
  EXPECT_NEAR((frame.T_OB(from_seconds(1.05)).p - before.p).norm(), 0.0, 1e-9);
  frame.add({from_seconds(1.10), 0.05, 0.0, 0.0, 1.0, 0.0});
  EXPECT_EQ(frame.jumps(), 1U);
  EXPECT_NEAR((frame.T_OB(from_seconds(1.10)).p - before.p).norm(), 0.05, 1e-9);
}

TEST(OdometryFrame, SaysWhenItKnowsNothing) {
  OdometryFrame frame;
  EXPECT_FALSE(frame.knows(from_seconds(1.0)));
  frame.add(on_circle(1.0));
  EXPECT_TRUE(frame.knows(from_seconds(1.2)));
  EXPECT_FALSE(frame.knows(from_seconds(3.0)));
}

TEST(OdometryFrame, CountsWhatItCannotUse) {
  OdometryFrame frame;
  frame.add(on_circle(1.0));
  frame.add(on_circle(1.0));
  frame.add(on_circle(0.5));
  frame.add({from_seconds(2.0), std::nan(""), 0.0, 0.0, 0.0, 0.0});
  EXPECT_EQ(frame.refused(), 3U);
}

}  // namespace
}  // namespace cosight::wearer
