#include "robot_agent/vins/imu.hpp"

#include <gtest/gtest.h>

#include <limits>

namespace cosight::vins {
namespace {

ImuSample sample(Stamp stamp, double x) {
  return {stamp, {x, 0.0, 0.0}, {0.0, x, 0.0}};
}

TEST(ImuBuffer, InterpolatesAtBothEndsOfASpan) {
  ImuBuffer buffer;
  for (int i = 0; i < 5; ++i)
    buffer.push(sample(i * 10, i));
  const auto samples = buffer.between(5, 32);
  ASSERT_EQ(samples.size(), 5U);
  EXPECT_EQ(samples.front().stamp, 5);
  EXPECT_DOUBLE_EQ(samples.front().acceleration_B.x(), 0.5);
  EXPECT_EQ(samples[1].stamp, 10);
  EXPECT_EQ(samples.back().stamp, 32);
  EXPECT_DOUBLE_EQ(samples.back().angular_velocity_B.y(), 3.2);
}

TEST(ImuBuffer, SpansThatEndOnASampleHaveItOnce) {
  ImuBuffer buffer;
  for (int i = 0; i < 5; ++i)
    buffer.push(sample(i * 10, i));
  EXPECT_EQ(buffer.between(10, 30).size(), 3U);
}

TEST(ImuBuffer, GoesOnAfterASampleFromTheFuture) {
  ImuBuffer buffer;
  EXPECT_TRUE(buffer.push(sample(10, 1.0)));
  EXPECT_TRUE(buffer.push(sample(10 + 5 * kNanosecondsPerSecond, 1.0)));
  EXPECT_TRUE(buffer.push(sample(20, 2.0)));
  EXPECT_TRUE(buffer.push(sample(30, 3.0)));
  EXPECT_TRUE(buffer.covers(10, 30));
  EXPECT_FALSE(buffer.covers(10, 31));
}

TEST(ImuBuffer, RefusesWhatIsOldOrNotFinite) {
  ImuBuffer buffer;
  EXPECT_TRUE(buffer.push(sample(10, 1.0)));
  EXPECT_FALSE(buffer.push(sample(10, 1.0)));
  EXPECT_FALSE(buffer.push(sample(5, 1.0)));
  EXPECT_FALSE(buffer.push(sample(20, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_FALSE(buffer.covers(10, 20));
}

TEST(ImuBuffer, FindsTheLongestGapOfASpanAndNoOther) {
  ImuBuffer buffer;
  for (const double t : {0.0, 0.01, 0.05, 0.06, 0.09, 0.10})
    buffer.push(sample(from_seconds(t), t));
  EXPECT_NEAR(buffer.longest_gap(from_seconds(0.0), from_seconds(0.1)), 0.04, 1e-9);
  EXPECT_NEAR(buffer.longest_gap(from_seconds(0.05), from_seconds(0.1)), 0.03, 1e-9);
  EXPECT_NEAR(buffer.longest_gap(from_seconds(0.0), from_seconds(0.005)), 0.01, 1e-9);
  EXPECT_NEAR(buffer.longest_gap(from_seconds(0.02), from_seconds(0.03)), 0.04, 1e-9) << "it lies in the gap";
}

TEST(ImuBuffer, KeepsWhatInterpolationStillNeeds) {
  ImuBuffer buffer;
  for (int i = 0; i < 5; ++i)
    buffer.push(sample(i * 10, i));
  buffer.drop_before(25);
  EXPECT_TRUE(buffer.covers(25, 40));
  EXPECT_FALSE(buffer.covers(15, 40));
}

}  // namespace
}  // namespace cosight::vins
