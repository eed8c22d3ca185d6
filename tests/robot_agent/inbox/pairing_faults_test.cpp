#include <gtest/gtest.h>

#include <limits>

#include "robot_agent/inbox/pairing.hpp"
#include "tests/robot_agent/inbox/pairing_fixture.hpp"

namespace cosight::inbox {
namespace {

/// What the pairing makes of peers that leave and samples that are late, lost, too many or wrong.
class PairingFaults : public PairingFixture {};

TEST_F(PairingFaults, APeerThatNeverComesDelaysNothingOnceTheStartIsOver) {
  pass_start_without_wearer();
  for (int i = 1; i <= 20; ++i) {
    robot(ms(1 + 33 * i));
    EXPECT_EQ(next_worn_stamp(), -1);
    wait(ms(33));
  }
  EXPECT_EQ(counters().wait_timeouts, 0U);
  EXPECT_EQ(counters().no_pair, 21U);
}

TEST_F(PairingFaults, APeerThatDiesDelaysNothingOnceItIsSilent) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(500));
  robot(ms(600));
  EXPECT_EQ(next_worn_stamp(), -1);
}

TEST_F(PairingFaults, APeerThatLeftIsNotWaitedFor) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(10));
  robot(ms(133));
  EXPECT_FALSE(next());
  pairing_.wearer_is_gone();
  EXPECT_EQ(next_worn_stamp(), -1);
}

TEST_F(PairingFaults, CountsLateWornFramesAndStillUsesThemForTheNextRobotFrame) {
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

TEST_F(PairingFaults, DropsWornFramesThatAreTooLateForAll) {
  robot(ms(100));
  wait(ms(150));
  EXPECT_EQ(next_worn_stamp(), -1);
  wearer(ms(55));
  EXPECT_EQ(counters().worn_late, 1U);
  EXPECT_EQ(counters().worn_unused, 1U);
}

TEST_F(PairingFaults, CountsFramesLostOnTheWay) {
  robot(ms(100));
  robot_sequence_ += 3;
  robot(ms(233));
  worn(ms(100));
  worn_sequence_ += 2;
  worn(ms(200));
  EXPECT_EQ(counters().robot_lost, 3U);
  EXPECT_EQ(counters().worn_lost, 2U);
}

TEST_F(PairingFaults, ASequenceThatStartsAnewLosesNothing) {
  worn_sequence_ = 500;
  worn(ms(100));
  worn_sequence_ = 0;
  worn(ms(133));
  EXPECT_EQ(counters().worn_lost, 0U);
}

TEST_F(PairingFaults, ARobotStampThatGoesBackIsRefusedAndCounted) {
  robot(ms(100));
  robot(ms(100));
  robot(ms(50));
  robot(ms(133));
  EXPECT_EQ(pairing_.queued_robot_frames(), 2U);
  EXPECT_EQ(counters().robot_out_of_order, 2U);
}

TEST_F(PairingFaults, AWornStampThatGoesBackIsSortedIn) {
  robot(ms(100));
  wearer(ms(130));
  wearer(ms(99));
  wearer(ms(131));
  EXPECT_EQ(next_worn_stamp(), ms(99));
  EXPECT_EQ(counters().worn_out_of_order, 1U);
}

TEST_F(PairingFaults, OneAbsurdWornStampDoesNotEndWaitingForGood) {
  wearer(ms(100'000'000));
  wearer(ms(90));
  robot(ms(100));
  EXPECT_FALSE(next());
  wearer(ms(101));
  EXPECT_EQ(next_worn_stamp(), ms(101));
}

TEST_F(PairingFaults, GoesOnAfterAGapInBothStreams) {
  robot(ms(100));
  wearer(ms(100));
  EXPECT_EQ(next_worn_stamp(), ms(100));
  wait(ms(5'000));
  robot(ms(5'100));
  wearer(ms(5'101));
  EXPECT_EQ(next_worn_stamp(), ms(5'101));
}

TEST_F(PairingFaults, AFullQueueGivesUpTheOldestImagesButNoFrame) {
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

TEST_F(PairingFaults, BytesAreBoundedAsWell) {
  for (int i = 0; i < 3; ++i) {
    ImageSample big = image(ms(1'000 + 33 * i), robot_sequence_++);
    big.bytes.assign(6'000, 0);
    pairing_.add_robot_frame(big, now_);
  }
  EXPECT_EQ(counters().robot_images_dropped, 2U);
}

TEST_F(PairingFaults, RowsAreBoundedAtLast) {
  for (int i = 0; i < 103; ++i)
    robot(ms(1'000 + 33 * i));
  EXPECT_EQ(pairing_.queued_robot_frames(), 100U);
  EXPECT_EQ(counters().robot_frames_dropped, 3U);
}

TEST_F(PairingFaults, AFullQueueOfWornFramesLosesTheOldest) {
  for (int i = 0; i < 6; ++i)
    wearer(ms(1'000 + 33 * i));
  EXPECT_EQ(counters().worn_dropped, 2U);
  robot(ms(1'066));
  EXPECT_EQ(next_worn_stamp(), ms(1'066));
}

TEST_F(PairingFaults, ARestartedWearerMayStartItsStampsAndSequenceAnew) {
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

TEST_F(PairingFaults, SamplesThatCanNotBeAreCountedAndIgnored) {
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
