#include "sim/motion/keyframes.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/motion/gaze_plan.hpp"

namespace cosight::sim {
namespace {

TEST(ValueAt, RestsAtKeyframesAndGlidesBetween) {
  const std::vector<Keyframe> keyframes{{1.0, 2.0}, {3.0, -4.0}};
  EXPECT_EQ(value_at(keyframes, 0.0), 2.0);
  EXPECT_EQ(value_at(keyframes, 1.0), 2.0);
  EXPECT_NEAR(value_at(keyframes, 2.0), -1.0, 1e-12);
  EXPECT_EQ(value_at(keyframes, 9.0), -4.0);
  EXPECT_EQ(value_at({}, 1.0), 0.0);
  EXPECT_NEAR((value_at(keyframes, 1.01) - 2.0) / 0.01, 0.0, 1e-3) << "no speed at a keyframe";
}

TEST(Glances, LookWithTheRobotForTheShareOfTheTime) {
  const GazePlan plan{.ratio = 0.4, .intervals = 4, .aside = 2.0, .turn_time = 0.5};
  const std::vector<Keyframe> keyframes = glances(plan, 0.4, 40.0, 3);
  int together = 0;
  int intervals = 0;
  bool before = false;
  for (int k = 0; k < 40000; ++k) {
    const bool now = value_at(keyframes, k / 1000.0) == 0.0;
    together += now ? 1 : 0;
    intervals += now && !before ? 1 : 0;
    before = now;
  }
  EXPECT_NEAR(together / 40000.0, 0.4, 0.01);
  EXPECT_EQ(intervals, 4);
  EXPECT_EQ(value_at(keyframes, 0.0), 0.0) << "begins with looking";
}

TEST(Glances, TurnToBothSides) {
  const std::vector<Keyframe> keyframes = glances({.intervals = 4, .aside = 2.0}, 0.3, 40.0, 3);
  double low = 0.0;
  double high = 0.0;
  for (const Keyframe& keyframe : keyframes) {
    low = std::min(low, keyframe.value);
    high = std::max(high, keyframe.value);
  }
  EXPECT_EQ(low, -2.0);
  EXPECT_EQ(high, 2.0);
}

}  // namespace
}  // namespace cosight::sim
