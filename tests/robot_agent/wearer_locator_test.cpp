#include "robot_agent/wearer_locator.hpp"

#include <gmock/gmock.h>

#include <vector>

#include "tests/robot_agent/standing_person.hpp"

namespace cosight::robot {
namespace {

using testing::ElementsAre;
using testing::IsEmpty;

constexpr Stamp ms(std::int64_t milliseconds) {
  return milliseconds * 1'000'000;
}

class WearerLocatorTest : public testing::Test {
 protected:
  void odometry(Stamp stamp) { locator_.add(WheelOdometrySample{.stamp = stamp}); }
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
  odometry(ms(0));
  scan(ms(30), "laser_front");
  scan(ms(10), "laser_rear");
  scan(ms(70), "laser_front");
  odometry(ms(50));
  EXPECT_THAT(used_, ElementsAre(ms(10), ms(30)));
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

}  // namespace
}  // namespace cosight::robot
