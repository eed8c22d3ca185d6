#include "robot_agent/intake.hpp"

#include <gtest/gtest.h>

#include "tests/robot_agent/standing_person.hpp"
#include "tests/shared/transport/inbox_of.hpp"

namespace cosight::robot {
namespace {

constexpr Stamp ms(std::int64_t milliseconds) {
  return milliseconds * 1'000'000;
}

WearerPoseSample tracked(Stamp stamp) {
  WearerPoseSample pose;
  pose.stamp = stamp;
  return pose;
}

/// An intake on a domain of its own, and somebody who listens to the wearer's poses.
class IntakeTest : public testing::Test {
 protected:
  std::uint64_t poses_in_inbox() const { return inbox_.counters().wearer_poses; }

  /// A person who stands ahead for a second: sent to `intake` with the odometry of a robot that stands.
  static void look(Intake& intake, Stamp from) {
    for (int i = 0; i < 25; ++i) {
      intake.push(WheelOdometrySample{.stamp = from + ms(40 * i)});
      intake.push(scan_of_person(from + ms(40 * i)));
    }
  }

  transport::Participant here_{transport::loopback("robot")};
  transport::Participant there_{transport::loopback("listener")};
  transport::InboxOf<WearerPoseSample> listener_{there_, transport::topics::kRobotWearerPose};
  inbox::Inbox inbox_{{}};
};

TEST_F(IntakeTest, WithoutALocatorATrackersPosesGoIn) {
  Intake intake(inbox_, here_, std::nullopt);
  EXPECT_TRUE(intake.takes_tracked_poses());
  intake.push(tracked(ms(1)));
  look(intake, ms(0));
  EXPECT_EQ(poses_in_inbox(), 1U);
}

TEST_F(IntakeTest, TheLasersAloneSayWhereTheWearerIsWhenAskedTo) {
  Intake intake(inbox_, here_, LocatorPlan{.options = {}, .yaw_WA = {}, .yields = false});
  EXPECT_FALSE(intake.takes_tracked_poses());
  intake.push(tracked(ms(1)));
  EXPECT_EQ(poses_in_inbox(), 0U);
  look(intake, ms(0));
  EXPECT_GT(poses_in_inbox(), 5U);
  Stamp now = ms(1000);
  EXPECT_TRUE(transport::eventually([&] {  // from when the writer knows its reader on
    look(intake, now);
    now += ms(1000);
    return listener_.wait_for(1, std::chrono::milliseconds{50});
  })) << "and others may know it";
}

TEST_F(IntakeTest, TheLasersYieldToATracker) {
  Intake intake(inbox_, here_, LocatorPlan{.options = {}, .yaw_WA = {}, .yields = true});
  look(intake, ms(0));
  const std::uint64_t located = poses_in_inbox();
  EXPECT_GT(located, 5U);
  intake.push(tracked(ms(1100)));
  look(intake, ms(1200));
  EXPECT_EQ(poses_in_inbox(), located + 1);
}

}  // namespace
}  // namespace cosight::robot
