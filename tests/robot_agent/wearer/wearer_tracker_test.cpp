#include "robot_agent/wearer/wearer_tracker.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <limits>

#include "tests/robot_agent/wearer/simulated_walk.hpp"

namespace cosight::wearer {
namespace {

/// A hall with two pillars and a table that the robot goes around in for a minute. Another person walks
/// through, twice near to the wearer's way.
constexpr const char* kMinute = R"(
name: minute
duration_s: 60
world:
  texel_m: 0.1
  outlines: [{corners_m: [[-6, -4.5], [6, -4.5], [6, 4.5], [-6, 4.5]]}]
  pillars: [{centre_m: [-1.5, -0.7], radius_m: 0.2}, {centre_m: [1.8, 0.9], radius_m: 0.3}]
  boxes: [{centre_m: [0, 4.1], size_m: [2, 0.6, 0.75]}]
robot:
  path: {waypoints_m: [[-4, -2.6], [4, -2.6], [4, 2.2], [-4, 2.2], [-4, -1]], corner_radius_m: 1, speed_mps: 0.45}
wearer:
  ahead_m: [[0, 1.2], [20, 1.2], [30, 1.8]]
  left_m: [[0, 0.6], [20, 0.6], [30, -0.5]]
passers_by:
  - {waypoints_m: [[4.5, -0.5], [0, -0.9], [-3.8, 0.2], [-4.2, 3.4], [5, 3.2]], corner_radius_m: 1, speed_mps: 0.7}
)";

/// The robot hardly moves; the wearer passes behind a pillar, hidden for about two seconds.
constexpr const char* kPillar = R"(
name: pillar
duration_s: 20
world:
  texel_m: 0.1
  outlines: [{corners_m: [[-3, -5], [9, -5], [9, 5], [-3, 5]]}]
  pillars: [{centre_m: [1.6, 0], radius_m: 0.35}]
robot: {path: {waypoints_m: [[0, 0], [2, 0]], speed_mps: 0.02}}
wearer:
  ahead_m: [[0, 3.2]]
  left_m: [[0, -1.8], [5, -1.8], [14, 1.8]]
)";

/// Somebody walks between the robot and the wearer, then back behind the wearer.
constexpr const char* kCrossing = R"(
name: crossing
duration_s: 16
world:
  texel_m: 0.1
  outlines: [{corners_m: [[-3, -5], [9, -5], [9, 5], [-3, 5]]}]
robot: {path: {waypoints_m: [[0, 0], [2, 0]], speed_mps: 0.05}}
wearer:
  ahead_m: [[0, 2.4], [6, 2.4], [10, 2.9]]
  left_m: [[0, -0.4], [3, -0.4], [9, 0.8]]
passers_by:
  - {waypoints_m: [[1.6, -3.5], [1.7, 2.0], [3.6, 2.0], [3.7, -3]], corner_radius_m: 0.8, speed_mps: 1.0, wait_s: 1}
)";

/// Where the wearer stands before the pillar.
WalkOptions far_ahead() {
  WalkOptions options;
  options.tracker.start.p_B = Eigen::Vector2d(3.2, -1.8);
  return options;
}

class MinuteOfWalking : public testing::TestWithParam<unsigned> {};

TEST_P(MinuteOfWalking, IsFollowedWithinFiveCentimetresAndAsSureAsItSays) {
  const WalkReport report = walk(scene_of(kMinute), GetParam());
  std::printf("rms %.3f m, worst %.3f m, NEES %.2f of 3, answered %.3f, %.0f us a scan\n", report.rms(),
              report.worst(), report.mean_nees(), report.share(),
              1e6 * report.seconds / static_cast<double>(report.scans));
  EXPECT_GT(report.share(), 0.98);
  EXPECT_LT(report.rms(), 0.05);
  EXPECT_LT(report.mean_nees(), 4.0);
  EXPECT_GT(report.mean_nees(), 0.7);
  EXPECT_EQ(report.counters.losses, 0U);
}

INSTANTIATE_TEST_SUITE_P(Seeds, MinuteOfWalking, testing::Values(1U, 2U, 3U));

TEST(WearerTracker, IsCaughtWhenItClaimsTooMuch) {
  WalkOptions options;
  options.tracker.person.pair_sigma = 0.004;
  options.tracker.person.leg_spread = 0.05;
  options.tracker.head.sway_sigma = 0.003;
  options.tracker.head.height_sigma = 0.004;
  options.tracker.head.tilt_sigma = 0.0;
  EXPECT_GT(walk(scene_of(kMinute), 1, options).mean_nees(), 4.0);
}

TEST(WearerTracker, LosesSightBehindAPillarAndFindsTheWearerAgain) {
  for (const unsigned seed : {1U, 2U, 3U}) {
    const WalkReport report = walk(scene_of(kPillar), seed, far_ahead());
    double hidden_since = report.answers.front().time;
    double longest = 0.0;
    double largest_sigma = 0.0;
    for (const Answer& answer : report.answers) {
      if (answer.laser != "laser_front") continue;
      if (answer.seen) {
        longest = std::max(longest, answer.time - hidden_since);
        hidden_since = answer.time;
      }
      largest_sigma = std::max(largest_sigma, std::sqrt(answer.covariance(1, 1)));
    }
    EXPECT_GT(longest, 2.0) << seed;
    EXPECT_GT(largest_sigma, 0.4) << seed;
    EXPECT_LT(report.answers.back().error.norm(), 0.1) << seed;
    EXPECT_GT(report.answers.back().time, 19.0) << seed;
    EXPECT_LT(report.mean_nees(), 4.0) << seed;
  }
}

TEST(WearerTracker, KeepsTheWearerApartFromSomebodyWhoCrosses) {
  for (const unsigned seed : {1U, 2U, 3U, 4U}) {
    const WalkReport report = walk(scene_of(kCrossing), seed);
    EXPECT_GT(report.share(), 0.9) << seed;
    EXPECT_LT(report.answers.back().error.norm(), 0.1) << seed;
    EXPECT_LT(report.rms(), 0.12) << seed;
    EXPECT_LT(report.mean_nees(), 4.0) << seed;
  }
}

TEST(WearerTracker, KnowsTheWearerOnlyToWithinTheHeadWithoutTheRobotsHeading) {
  WalkOptions options;
  options.with_heading = false;
  const WalkReport report = walk(scene_of(kMinute), 1, options);
  EXPECT_LT(report.rms(), 0.15);
  EXPECT_LT(report.mean_nees(), 4.0);
  EXPECT_GT(report.rms(), 0.09);
}

TEST(WearerTracker, FollowsTheWearerWithoutOdometry) {
  WalkOptions options = far_ahead();
  options.with_odometry = false;
  options.with_heading = false;
  const WalkReport report = walk(scene_of(kPillar), 1, options);
  EXPECT_GT(report.share(), 0.8);
  EXPECT_LT(report.answers.back().error.norm(), 0.25);
  EXPECT_EQ(report.counters.scans_without_odometry, report.counters.scans);
}

TEST(WearerTracker, SaysTheSameForTheSameSamples) {
  const WalkReport a = walk(scene_of(kCrossing), 1);
  const WalkReport b = walk(scene_of(kCrossing), 1);
  ASSERT_EQ(a.answers.size(), b.answers.size());
  for (std::size_t k = 0; k < a.answers.size(); ++k)
    EXPECT_EQ(a.answers[k].error, b.answers[k].error);
}

LaserScanSample empty_room(Stamp stamp) {
  LaserScanSample scan;
  scan.stamp = stamp;
  scan.laser = "laser_front";
  scan.angle_min = -1.5F;
  scan.angle_increment = 0.025F;
  scan.range_min = 0.3F;
  scan.range_max = 20.0F;
  scan.ranges.assign(120, 5.0F);
  return scan;
}

TEST(WearerTracker, CountsScansThatItCannotUse) {
  WearerTracker tracker;
  EXPECT_FALSE(tracker.add_scan(empty_room(from_seconds(2.0))));
  LaserScanSample unknown = empty_room(from_seconds(3.0));
  unknown.laser = "laser_roof";
  tracker.add_scan(unknown);
  LaserScanSample nothing = empty_room(from_seconds(3.0));
  nothing.ranges.clear();
  tracker.add_scan(nothing);
  LaserScanSample nan = empty_room(from_seconds(3.0));
  nan.angle_min = std::numeric_limits<float>::quiet_NaN();
  tracker.add_scan(nan);
  tracker.add_scan(empty_room(from_seconds(1.0)));
  EXPECT_EQ(tracker.counters().scans, 5U);
  EXPECT_EQ(tracker.counters().scans_refused, 3U);
  EXPECT_EQ(tracker.counters().scans_late, 1U);
}

TEST(WearerTracker, SurvivesScansOfNonsense) {
  WearerTracker tracker;
  const float nan = std::numeric_limits<float>::quiet_NaN();
  unsigned noise = 1;
  for (int k = 0; k < 200; ++k) {
    LaserScanSample scan = empty_room(from_seconds(1.0 + 0.04 * k));
    for (float& range : scan.ranges) {
      noise = noise * 1664525U + 1013904223U;
      range = noise % 7U == 0U ? nan : static_cast<float>(noise >> 8U) * 5e-7F;
    }
    const auto pose = tracker.add_scan(scan);
    if (pose) {
      EXPECT_TRUE(pose->T_SF.T.p.allFinite());
    }
  }
  EXPECT_EQ(tracker.counters().scans, 200U);
}

}  // namespace
}  // namespace cosight::wearer
