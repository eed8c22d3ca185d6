#include "robot_agent/inbox/pairing.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace cosight::inbox {
namespace {

constexpr Stamp ms(std::int64_t milliseconds) {
  return from_milliseconds(milliseconds);
}

/// A pairing whose time is set by hand: `now` is the arrival clock, the stamps are chosen freely.
class PairingTest : public testing::Test {
 protected:
  void robot(Stamp stamp) { pairing_.add_robot_frame(image(stamp, robot_sequence_++), now_); }
  void worn(Stamp stamp) { pairing_.add_worn_frame(image(stamp, worn_sequence_++), now_); }
  void pose(Stamp stamp, double x = 0.0) {
    WearerPoseSample sample;
    sample.stamp = stamp;
    sample.T_SF.T.p.x() = x;
    sample.T_SF.covariance = 1e-4 * Eigen::Matrix<double, 6, 6>::Identity();
    pairing_.add_pose(sample, now_);
  }
  void ahrs(Stamp stamp) {
    AhrsSample sample;
    sample.stamp = stamp;
    pairing_.add_ahrs(sample, now_);
  }
  /// A wearer that sends everything for `stamp` at once.
  void wearer(Stamp stamp) {
    ahrs(stamp);
    pose(stamp);
    worn(stamp);
  }
  void wait(Stamp duration) { now_ += duration; }
  std::optional<PairedFrame> next() { return pairing_.next(now_); }
  /// Stamp of the worn frame of the next robot frame; -1 without one; -2 when no robot frame is ready.
  Stamp next_worn_stamp() {
    const auto paired = next();
    if (!paired) return -2;
    return paired->worn ? paired->worn->frame.stamp : -1;
  }
  /// The benefit of the doubt at the start is over, and no wearer was heard.
  void pass_start_without_wearer() {
    robot(ms(1));
    wait(ms(10'000));
    ASSERT_EQ(next_worn_stamp(), -1);
  }
  const InboxCounters& counters() const { return pairing_.counters(); }

  static ImageSample image(Stamp stamp, std::uint64_t sequence) {
    ImageSample sample;
    sample.stamp = stamp;
    sample.sequence = sequence;
    sample.bytes.assign(100, 0);
    return sample;
  }

  PairingOptions options_{.max_queued_images = 4, .max_queued_bytes = 10'000, .max_queued_frames = 100};
  Pairing pairing_{options_, InterpolationOptions{}, MountingOptions{}};
  Stamp now_ = ms(50'000);
  std::uint64_t robot_sequence_ = 0;
  std::uint64_t worn_sequence_ = 0;
};

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

TEST_F(PairingTest, APeerThatNeverComesDelaysNothingOnceTheStartIsOver) {
  pass_start_without_wearer();
  for (int i = 1; i <= 20; ++i) {
    robot(ms(1 + 33 * i));
    EXPECT_EQ(next_worn_stamp(), -1);
    wait(ms(33));
  }
  EXPECT_EQ(counters().wait_timeouts, 0U);
  EXPECT_EQ(counters().no_pair, 21U);
}

TEST_F(PairingTest, APeerThatDiesDelaysNothingOnceItIsSilent) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(500));
  robot(ms(600));
  EXPECT_EQ(next_worn_stamp(), -1);
}

TEST_F(PairingTest, APeerThatLeftIsNotWaitedFor) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(10));
  robot(ms(133));
  EXPECT_FALSE(next());
  pairing_.wearer_is_gone();
  EXPECT_EQ(next_worn_stamp(), -1);
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

TEST_F(PairingTest, CountsLateWornFramesAndStillUsesThemForTheNextRobotFrame) {
  robot(ms(100));
  wearer(ms(60));
  wait(ms(150));
  EXPECT_EQ(next_worn_stamp(), ms(60));
  wearer(ms(99));
  EXPECT_EQ(counters().worn_late, 1U);
  robot(ms(133));
  wait(ms(150));
  EXPECT_EQ(next_worn_stamp(), ms(99));
}

TEST_F(PairingTest, DropsWornFramesThatAreTooLateForAll) {
  robot(ms(100));
  wait(ms(150));
  EXPECT_EQ(next_worn_stamp(), -1);
  wearer(ms(55));
  EXPECT_EQ(counters().worn_late, 1U);
  EXPECT_EQ(counters().worn_unused, 1U);
}

TEST_F(PairingTest, CountsFramesLostOnTheWay) {
  robot(ms(100));
  robot_sequence_ += 3;
  robot(ms(233));
  worn(ms(100));
  worn_sequence_ += 2;
  worn(ms(200));
  EXPECT_EQ(counters().robot_lost, 3U);
  EXPECT_EQ(counters().worn_lost, 2U);
}

TEST_F(PairingTest, ASequenceThatStartsAnewLosesNothing) {
  worn_sequence_ = 500;
  worn(ms(100));
  worn_sequence_ = 0;
  worn(ms(133));
  EXPECT_EQ(counters().worn_lost, 0U);
}

TEST_F(PairingTest, ARobotStampThatGoesBackIsRefusedAndCounted) {
  robot(ms(100));
  robot(ms(100));
  robot(ms(50));
  robot(ms(133));
  EXPECT_EQ(pairing_.queued_robot_frames(), 2U);
  EXPECT_EQ(counters().robot_out_of_order, 2U);
}

TEST_F(PairingTest, AWornStampThatGoesBackIsSortedIn) {
  robot(ms(100));
  wearer(ms(130));
  wearer(ms(99));
  wearer(ms(131));
  EXPECT_EQ(next_worn_stamp(), ms(99));
  EXPECT_EQ(counters().worn_out_of_order, 1U);
}

TEST_F(PairingTest, OneAbsurdWornStampDoesNotEndWaitingForGood) {
  wearer(ms(100'000'000));
  wearer(ms(90));
  robot(ms(100));
  EXPECT_FALSE(next());
  wearer(ms(101));
  EXPECT_EQ(next_worn_stamp(), ms(101));
}

TEST_F(PairingTest, GoesOnAfterAGapInBothStreams) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(5'000));
  robot(ms(5'100));
  wearer(ms(5'101));
  EXPECT_EQ(next_worn_stamp(), ms(5'101));
}

TEST_F(PairingTest, AFullQueueGivesUpTheOldestImagesButNoFrame) {
  for (int i = 0; i < 7; ++i)
    robot(ms(1'000 + 33 * i));
  EXPECT_EQ(counters().robot_images_dropped, 3U);
  for (int i = 0; i < 3; ++i) {
    const auto paired = next();
    ASSERT_TRUE(paired);
    EXPECT_TRUE(paired->image_dropped);
    EXPECT_TRUE(paired->frame.bytes.empty());
  }
  wait(ms(150));
  for (int i = 3; i < 7; ++i) {
    const auto paired = next();
    ASSERT_TRUE(paired);
    EXPECT_FALSE(paired->image_dropped);
    EXPECT_EQ(paired->frame.stamp, ms(1'000 + 33 * i));
    EXPECT_EQ(paired->frame.bytes.size(), 100U);
  }
}

TEST_F(PairingTest, BytesAreBoundedAsWell) {
  for (int i = 0; i < 3; ++i) {
    ImageSample big = image(ms(1'000 + 33 * i), robot_sequence_++);
    big.bytes.assign(6'000, 0);
    pairing_.add_robot_frame(big, now_);
  }
  EXPECT_EQ(counters().robot_images_dropped, 2U);
}

TEST_F(PairingTest, RowsAreBoundedAtLast) {
  for (int i = 0; i < 103; ++i)
    robot(ms(1'000 + 33 * i));
  EXPECT_EQ(pairing_.queued_robot_frames(), 100U);
  EXPECT_EQ(counters().robot_frames_dropped, 3U);
}

TEST_F(PairingTest, AFullQueueOfWornFramesLosesTheOldest) {
  for (int i = 0; i < 6; ++i)
    wearer(ms(1'000 + 33 * i));
  EXPECT_EQ(counters().worn_dropped, 2U);
  robot(ms(1'066));
  EXPECT_EQ(next_worn_stamp(), ms(1'066));
}

TEST_F(PairingTest, ARestartedWearerMayStartItsStampsAndSequenceAnew) {
  worn_sequence_ = 70;
  robot(ms(5'000));
  wearer(ms(5'000));
  EXPECT_EQ(next_worn_stamp(), ms(5'000));
  wearer(ms(5'030));
  pairing_.wearer_restarted();
  worn_sequence_ = 0;
  robot(ms(5'033));
  EXPECT_FALSE(next());
  wearer(ms(5'034));
  EXPECT_EQ(next_worn_stamp(), ms(5'034));
  EXPECT_EQ(counters().wearer_restarts, 1U);
  EXPECT_EQ(counters().worn_lost, 0U);
}

TEST_F(PairingTest, SamplesThatCanNotBeAreCountedAndIgnored) {
  WearerPoseSample pose_sample;
  pose_sample.T_SF.T.p.x() = std::numeric_limits<double>::quiet_NaN();
  pairing_.add_pose(pose_sample, now_);
  AhrsSample ahrs_sample;
  ahrs_sample.q_WH.coeffs() *= 2.0;
  pairing_.add_ahrs(ahrs_sample, now_);
  EXPECT_EQ(counters().invalid_samples, 2U);
  EXPECT_EQ(counters().wearer_poses + counters().ahrs_samples, 0U);
}

}  // namespace
}  // namespace cosight::inbox
