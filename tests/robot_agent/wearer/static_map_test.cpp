#include "robot_agent/wearer/static_map.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cosight::wearer {
namespace {

/// One turn of a laser in the origin: something at `range` [m] about straight ahead, a wall behind it.
PlanarScan scan_at(double time, double range) {
  LaserScanSample sample;
  sample.stamp = from_seconds(time);
  sample.angle_min = -0.5F;
  sample.angle_increment = 0.02F;
  sample.range_max = 20.0F;
  for (int k = 0; k < 51; ++k)
    sample.ranges.push_back(std::abs(k - 25) <= 3 ? static_cast<float>(range) : 6.0F);
  SceneOptions scene;
  scene.own_body = {Eigen::Vector2d(-0.1, -0.1), Eigen::Vector2d(0.1, 0.1)};
  return *seen_from_above(sample, {{}, 0.01}, {}, scene);
}

const Eigen::Vector2d kPlace(2.0, 0.0);

TEST(StaticMap, TakesWhatStaysForFurniture) {
  StaticMap map{SceneOptions{}};
  for (int k = 0; k < 10; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 2.0), {});
  EXPECT_FALSE(map.is_static(kPlace));
  for (int k = 10; k < 40; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 2.0), {});
  EXPECT_TRUE(map.is_static(kPlace));
}

TEST(StaticMap, NeverTakesATrackedPersonForFurniture) {
  StaticMap map{SceneOptions{}};
  const std::vector<Eigen::Vector2d> people{{2.1, 0.0}};
  for (int k = 0; k < 500; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 2.0), people);
  EXPECT_FALSE(map.is_static(kPlace));
}

TEST(StaticMap, GivesAPlaceFreeThatTheLaserLooksThrough) {
  StaticMap map{SceneOptions{}};
  for (int k = 0; k < 200; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 2.0), {});
  EXPECT_TRUE(map.is_static(kPlace));
  for (int k = 200; k < 320; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 6.0), {});
  EXPECT_FALSE(map.is_static(kPlace));
}

TEST(StaticMap, ForgetsWhatItHasNotSeenForLong) {
  StaticMap map{SceneOptions{}};
  for (int k = 0; k < 50; ++k)
    map.observe(scan_at(1.0 + 0.04 * k, 2.0), {});
  EXPECT_GT(map.size(), 0U);
  PlanarScan nothing = scan_at(30.0, 2.0);
  nothing.ranges.assign(nothing.ranges.size(), 0.0);
  nothing.points.clear();
  map.observe(nothing, {});
  EXPECT_EQ(map.size(), 0U);
}

}  // namespace
}  // namespace cosight::wearer
