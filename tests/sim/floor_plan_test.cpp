#include "sim/world/floor_plan.hpp"

#include <gtest/gtest.h>

#include <stdexcept>

namespace cosight::sim {
namespace {

FloorPlan small_room() {
  FloorPlan plan;
  plan.outlines.push_back({{{0, 0}, {3, 0}, {3, 2}, {0, 2}}, Material::kPlaster, 0.8});
  plan.texel = 0.02;
  return plan;
}

TEST(BuildScene, ClosesTheRoomInAllDirections) {
  const Scene scene = build_scene(small_room(), 1);
  const Eigen::Vector3d eye(1.0, 0.7, 1.2);
  const std::vector<std::pair<Eigen::Vector3d, double>> expected{{{1, 0, 0}, 2.0},  {{-1, 0, 0}, 1.0},
                                                                 {{0, 1, 0}, 1.3},  {{0, -1, 0}, 0.7},
                                                                 {{0, 0, -1}, 1.2}, {{0, 0, 1}, 1.5}};
  for (const auto& [direction, range] : expected) {
    const auto hit = cast_ray(scene.quads, eye, direction);
    ASSERT_TRUE(hit) << direction.transpose();
    EXPECT_NEAR(hit->range, range, 1e-9);
  }
}

TEST(BuildScene, PutsAPatchInFrontOfItsWallAtTheRightPlace) {
  FloorPlan plan = small_room();
  plan.patches.push_back({.outline = 0, .wall = 0, .from = 0.5, .to = 1.0, .bottom = 1.0, .top = 1.5});
  const Scene scene = build_scene(plan, 1);
  const auto range_at = [&](double x, double z) {
    return cast_ray(scene.quads, {x, 1.0, z}, {0, -1, 0})->range;
  };
  EXPECT_LT(range_at(0.75, 1.25), 0.995);
  EXPECT_NEAR(range_at(0.45, 1.25), 1.0, 1e-9);
  EXPECT_NEAR(range_at(1.05, 1.25), 1.0, 1e-9);
  EXPECT_NEAR(range_at(0.75, 1.55), 1.0, 1e-9);
}

TEST(BuildScene, DrawsTheSameFromTheSameSeedOnly) {
  const Scene a = build_scene(small_room(), 7);
  const Scene b = build_scene(small_room(), 7);
  const Scene c = build_scene(small_room(), 8);
  int different = 0;
  for (float u = 0.5F; u < 100.0F; u += 3.0F) {
    const auto sample = [&](const Scene& scene) { return scene.textures[2]->sample(u, 60.0F, {}); };
    EXPECT_EQ(sample(a), sample(b));
    different += sample(a) != sample(c) ? 1 : 0;
  }
  EXPECT_GT(different, 10);
}

TEST(BuildScene, RefusesAPatchOnAWallThatDoesNotExist) {
  FloorPlan plan = small_room();
  plan.patches.push_back({.outline = 0, .wall = 4});
  EXPECT_THROW(build_scene(plan, 1), std::invalid_argument);
  EXPECT_THROW(build_scene(FloorPlan{}, 1), std::invalid_argument);
}

}  // namespace
}  // namespace cosight::sim
