#include "sim/world/scene.hpp"

#include <gtest/gtest.h>

#include "sim/world/solids.hpp"
#include "test_quads.hpp"

namespace cosight::sim {
namespace {

TEST(CastRay, MeetsAWallWhereThePlaneIs) {
  const Texture texture(gradient(100, 0));
  const std::vector<Quad> quads{wall_ahead(4.0, 6.0, texture)};
  const auto hit = cast_ray(quads, {0, 0, 0}, Eigen::Vector3d(1.0, 0.25, -0.5));
  ASSERT_TRUE(hit);
  EXPECT_NEAR(hit->range, 4.0, 1e-12);
  EXPECT_NEAR(hit->s, (3.0 - 1.0) / 6.0, 1e-12);
  EXPECT_NEAR(hit->t, (3.0 + 2.0) / 6.0, 1e-12);
}

TEST(CastRay, SeesNothingBehindBesideOrFromTheBack) {
  const Texture texture(gradient(100, 0));
  const std::vector<Quad> quads{wall_ahead(4.0, 2.0, texture)};
  EXPECT_FALSE(cast_ray(quads, {0, 0, 0}, {-1, 0, 0}));
  EXPECT_FALSE(cast_ray(quads, {0, 0, 0}, {1, 1, 0}));
  EXPECT_FALSE(cast_ray(quads, {8, 0, 0}, {-1, 0, 0}));
}

TEST(CastRay, TakesTheNearerOfTwo) {
  const Texture texture(gradient(100, 0));
  const std::vector<Quad> quads{wall_ahead(5.0, 6.0, texture), wall_ahead(3.0, 1.0, texture)};
  EXPECT_EQ(cast_ray(quads, {0, 0, 0}, {1, 0, 0})->quad, 1U);
  EXPECT_EQ(cast_ray(quads, {0, 0, 0}, {1, 0.2, 0})->quad, 0U);
}

TEST(BoxSides, AreSeenFromOutsideAllAround) {
  const Pose T_WX{Eigen::Quaterniond(Eigen::AngleAxisd(0.4, Eigen::Vector3d::UnitZ())), {2.0, 1.0, 0.5}};
  const std::vector<Quad> sides = box_sides(T_WX, {1.0, 0.6, 0.8});
  const Eigen::Vector3d middle = T_WX * Eigen::Vector3d(0, 0, 0.4);
  const std::vector<std::pair<Eigen::Vector3d, double>> views{
      {Eigen::Vector3d::UnitX(), 0.5}, {Eigen::Vector3d::UnitY(), 0.3}, {Eigen::Vector3d::UnitZ(), 0.4}};
  for (const auto& [axis, half] : views) {
    for (const double side : {1.0, -1.0}) {
      const Eigen::Vector3d outward = side * (T_WX.q * axis);
      const auto hit = cast_ray(sides, middle + 3.0 * outward, -outward);
      ASSERT_TRUE(hit);
      EXPECT_NEAR(hit->range, 3.0 - half, 1e-9);
    }
  }
}

TEST(RingSides, WearTheirPictureTheRightWayRound) {
  const Texture texture(gradient(20, 1));
  Quad sheet;
  sheet.texture = &texture;
  sheet.u1 = 200.0F;
  sheet.v1 = 200.0F;
  const std::vector<Quad> sides = ring_sides(Pose{}, 0.5, 2.0, 16, sheet);
  const auto left = cast_ray(sides, {4.0, -0.2, 1.0}, {-1, 0, 0});
  const auto right = cast_ray(sides, {4.0, 0.2, 1.0}, {-1, 0, 0});
  ASSERT_TRUE(left && right);
  // Whoever looks along -x has +y on the right; u grows to the right, across the seam at y = 0.
  EXPECT_GT(sides[left->quad].u0, sides[right->quad].u0);
  EXPECT_LT(sides[right->quad].u0, 50.0F);
  EXPECT_GT(right->range, 3.4);
  EXPECT_LT(right->range, 3.65);
}

}  // namespace
}  // namespace cosight::sim
