#include "robot_agent/slam/health.hpp"

#include <gtest/gtest.h>

namespace cosight::slam {
namespace {

constexpr Stamp kFrame = kNanosecondsPerSecond / 10;

/// Ten frames a second, each with so many landmarks looked for and so many of them believed.
class HealthOfFrames : public testing::Test {
 protected:
  HealthOfFrames() { health_.restart(stamp_); }

  void frames(int count, int searched, int fused) {
    SearchCounts search;
    search.searched = searched;
    search.fused_pixels = fused;
    for (int i = 0; i < count; ++i)
      health_.note(stamp_ += kFrame, search, {});
  }

  Stamp stamp_ = 100 * kNanosecondsPerSecond;
  Health health_{HealthOptions{}};
};

TEST_F(HealthOfFrames, IsLostAfterHalfASecondWithoutAMatch) {
  frames(20, 40, 38);
  EXPECT_TRUE(health_.is_sure());
  frames(5, 0, 0);
  EXPECT_FALSE(health_.is_sure());
  EXPECT_FALSE(health_.is_lost());
  frames(1, 0, 0);
  EXPECT_TRUE(health_.is_lost());
}

TEST_F(HealthOfFrames, IsLostWhereOnlyAFewOfTheLandmarksAreBelieved) {
  frames(20, 40, 38);
  EXPECT_NEAR(health_.test_ratio(), 38.0 / 40.0, 1e-9);
  frames(20, 40, 12);
  EXPECT_FALSE(health_.is_lost()) << "three in ten";
  frames(10, 40, 4);
  EXPECT_TRUE(health_.is_lost()) << "one in ten, though there are matches in every frame";
}

TEST_F(HealthOfFrames, TakesAShareOfAFewForChance) {
  frames(20, 1, 0);
  EXPECT_EQ(health_.test_ratio(), 1.0);
}

TEST_F(HealthOfFrames, WantsANewMapASecondLaterUnlessMatchesComeBack) {
  frames(6, 40, 0);
  EXPECT_FALSE(health_.needs_reset(stamp_));
  frames(6, 40, 39);
  EXPECT_FALSE(health_.is_lost());
  frames(20, 40, 0);
  EXPECT_TRUE(health_.needs_reset(stamp_));
  health_.restart(stamp_);
  EXPECT_FALSE(health_.is_lost());
  EXPECT_FALSE(health_.needs_reset(stamp_ + 10 * kNanosecondsPerSecond));
}

}  // namespace
}  // namespace cosight::slam
