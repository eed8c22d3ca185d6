#include "robot_agent/inbox/pairing.hpp"

#include <gtest/gtest.h>

#include <vector>

#include "tests/robot_agent/inbox/pairing_fixture.hpp"

namespace cosight::inbox {
namespace {

class PairingTest : public PairingFixture {};

TEST_F(PairingTest, EqualStampsPairAtOnce) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  EXPECT_EQ(next_worn_stamp(), -2);
  EXPECT_EQ(counters().paired, 1U);
}

TEST_F(PairingTest, WaitsUntilALaterWornFrameShowsWhichIsNearest) {
  robot(ms(100));
  wearer(ms(90));
  EXPECT_FALSE(next());
  wearer(ms(104));
  EXPECT_EQ(next_worn_stamp(), ms(104));
}

TEST_F(PairingTest, AWornFrameThatIsTooFarIsNotTaken) {
  robot(ms(100));
  wearer(ms(59));
  wearer(ms(141));
  EXPECT_EQ(next_worn_stamp(), -1);
  EXPECT_EQ(counters().no_pair, 1U);
}

TEST_F(PairingTest, WaitingEndsAfterMaxWait) {
  robot(ms(100));
  wearer(ms(90));
  wait(ms(149));
  EXPECT_FALSE(next());
  wait(ms(1));
  EXPECT_EQ(pairing_.deadline(), now_);
  EXPECT_EQ(next_worn_stamp(), ms(90));
  EXPECT_EQ(counters().wait_timeouts, 1U);
}

TEST_F(PairingTest, HeartbeatsKeepARarelySeeingWearerWaitedFor) {
  pass_start_without_wearer();
  pairing_.wearer_is_alive(now_);
  pose(ms(3'000));
  robot(ms(3'000));
  EXPECT_FALSE(next());
  wait(ms(20));
  worn(ms(3'000));
  EXPECT_EQ(next_worn_stamp(), ms(3'000));
}

TEST_F(PairingTest, WaitsForThePoseOfTheChosenWornFrame) {
  robot(ms(100));
  ahrs(ms(101));
  worn(ms(101));
  EXPECT_FALSE(next());
  pose(ms(101), 0.7);
  const auto paired = next();
  ASSERT_TRUE(paired && paired->worn);
  EXPECT_EQ(paired->worn->pose.T_SF.T.p.x(), 0.7);
}

TEST_F(PairingTest, DoesNotWaitForAPoseThatNobodyHas) {
  robot(0);
  worn(0);
  ahrs(0);
  EXPECT_EQ(next_worn_stamp(), -2);
  pairing_.add_no_pose(ms(-1), now_);
  EXPECT_EQ(next_worn_stamp(), -2) << "it may still come to know";
  pairing_.add_no_pose(ms(3), now_);
  const auto paired = next();
  ASSERT_TRUE(paired);
  EXPECT_TRUE(paired->wearer_pose_missing);
  EXPECT_EQ(counters().wait_timeouts, 0U);
}

TEST_F(PairingTest, InterpolatesThePoseWhenTheNextOneIsLate) {
  robot(ms(100));
  ahrs(ms(110));
  pose(ms(90), 1.0);
  worn(ms(100));
  EXPECT_FALSE(next());
  pose(ms(110), 2.0);
  const auto paired = next();
  ASSERT_TRUE(paired && paired->worn);
  EXPECT_DOUBLE_EQ(paired->worn->pose.T_SF.T.p.x(), 1.5);
}

TEST_F(PairingTest, AWornFrameWithoutAPoseIsSaidToLackIt) {
  robot(ms(100));
  worn(ms(100));
  wait(ms(150));
  const auto paired = next();
  ASSERT_TRUE(paired);
  EXPECT_FALSE(paired->worn);
  EXPECT_TRUE(paired->wearer_pose_missing);
  EXPECT_EQ(counters().no_pose, 1U);
}

TEST_F(PairingTest, CountsPairsWithoutAnyOrientation) {
  WearerPoseSample position_only;
  position_only.stamp = ms(100);
  position_only.has_orientation = false;
  position_only.T_SF.covariance.topLeftCorner<3, 3>().setIdentity();
  position_only.T_SF.covariance.bottomRightCorner<3, 3>() = -Eigen::Matrix3d::Identity();
  robot(ms(100));
  pairing_.add_pose(position_only, now_);
  worn(ms(100));
  wait(ms(150));
  const auto paired = next();
  ASSERT_TRUE(paired && paired->worn);
  EXPECT_FALSE(paired->worn->pose.has_orientation);
  EXPECT_EQ(counters().no_orientation, 1U);
}

TEST_F(PairingTest, EachWornFrameServesOneRobotFrame) {
  robot(ms(100));
  robot(ms(110));
  wearer(ms(104));
  wearer(ms(114));
  EXPECT_EQ(next_worn_stamp(), ms(104));
  EXPECT_EQ(next_worn_stamp(), ms(114));
}

TEST_F(PairingTest, LeavesAWornFrameToTheRobotFrameThatIsNearerToIt) {
  // Worn frames come 20 ms after a robot frame and 13 ms before the next.
  std::vector<Stamp> pairs;
  for (int i = 0; i < 6; ++i) {
    robot(ms(1'000 + 33 * i));
    wearer(ms(1'020 + 33 * i));
    pairs.push_back(next_worn_stamp());
  }
  EXPECT_EQ(pairs[0], ms(1'020));  // the interval isn't known yet
  EXPECT_EQ(pairs[1], -1);
  for (int i = 2; i < 6; ++i)
    EXPECT_EQ(pairs[static_cast<std::size_t>(i)], ms(1'020 + 33 * (i - 1)));
}

TEST_F(PairingTest, AWearerAtHalfTheRateServesEverySecondFrame) {
  std::vector<Stamp> pairs;
  for (int i = 0; i < 6; ++i) {
    if (i % 2 == 0) wearer(ms(1'000 + 33 * i));
    robot(ms(1'000 + 33 * i));
    wait(ms(i % 2 == 0 ? 0 : 150));
    pairs.push_back(next_worn_stamp());
  }
  EXPECT_EQ(pairs, (std::vector<Stamp>{ms(1'000), -1, ms(1'066), -1, ms(1'132), -1}));
}

TEST_F(PairingTest, TheResultDoesNotDependOnWhenFramesAreTakenOut) {
  std::vector<Stamp> one_by_one;
  for (int i = 0; i < 4; ++i) {
    robot(ms(1'000 + 33 * i));
    wearer(ms(1'018 + 33 * i));
    one_by_one.push_back(next_worn_stamp());
  }
  pairing_ = Pairing(options_, {}, {});
  for (int i = 0; i < 4; ++i) {
    robot(ms(1'000 + 33 * i));
    wearer(ms(1'018 + 33 * i));
  }
  std::vector<Stamp> at_once;
  for (int i = 0; i < 4; ++i)
    at_once.push_back(next_worn_stamp());
  EXPECT_EQ(at_once, one_by_one);
}

}  // namespace
}  // namespace cosight::inbox
