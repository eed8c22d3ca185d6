#include "shared/geometry/convex_polygon.hpp"

#include <gtest/gtest.h>

#include <random>
#include <vector>

namespace cosight {
namespace {

TEST(ConvexHull, HoldsAllItsPointsAndNoMoreCornersThanNeeded) {
  std::mt19937 random(1);
  std::normal_distribution<double> normal(0.0, 100.0);
  for (int trial = 0; trial < 50; ++trial) {
    std::vector<Eigen::Vector2d> points;
    for (int i = 0; i < 3 + 2 * trial; ++i)
      points.emplace_back(normal(random), normal(random));
    const ConvexPolygon hull = convex_hull(points);
    ASSERT_GE(hull.size(), 3U);
    EXPECT_GT(area(hull), 0.0);
    for (const Eigen::Vector2d& point : points)
      EXPECT_TRUE(contains(hull, point));
    EXPECT_EQ(convex_hull(hull).size(), hull.size());
  }
}

TEST(ConvexHull, KeepsTheEndsOfALineThatRoundingBent) {
  // The first three lie on the right edge; sorted by x they go up and down along it.
  const std::vector<Eigen::Vector2d> points{
      {0.64, 0.48}, {0.64 - 1e-16, -0.48}, {0.64 - 2e-16, 0.2}, {-0.64, 0.0}};
  EXPECT_NEAR(area(convex_hull(points)), 0.5 * 0.96 * 1.28, 1e-6);
}

TEST(ConvexHull, OfALineOrAPointIsEmpty) {
  EXPECT_TRUE(convex_hull({}).empty());
  EXPECT_TRUE(convex_hull({{1, 1}, {1, 1}, {1, 1}, {1, 1}}).empty());
  EXPECT_TRUE(convex_hull({{0, 0}, {1, 1}, {2, 2}, {3, 3}}).empty());
}

TEST(Clip, AreaIsTheShareOfPointsInBoth) {
  const ConvexPolygon triangle{{-2, -1}, {7, 2}, {1, 8}};
  const Rectangle rectangle{{0, 0}, {4, 5}};
  const ConvexPolygon clipped = clip(triangle, rectangle);
  std::mt19937 random(1);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int inside = 0;
  constexpr int kSamples = 200000;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector2d point(4.0 * unit(random), 5.0 * unit(random));
    inside += contains(triangle, point) ? 1 : 0;
    EXPECT_EQ(contains(triangle, point), contains(clipped, point));
  }
  EXPECT_NEAR(area(clipped), 20.0 * inside / kSamples, 0.1);
}

TEST(Clip, OfWhatLiesOutsideIsEmpty) {
  const ConvexPolygon triangle{{10, 10}, {20, 10}, {10, 20}};
  EXPECT_TRUE(clip(triangle, {{0, 0}, {5, 5}}).empty());
  EXPECT_TRUE(clip({}, {{0, 0}, {5, 5}}).empty());
  EXPECT_EQ(clip(triangle, {{0, 0}, {50, 50}}).size(), 3U);
}

}  // namespace
}  // namespace cosight
