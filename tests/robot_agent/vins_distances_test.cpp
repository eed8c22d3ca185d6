#include "robot_agent/vins_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cosight::robot {
namespace {

CameraModel camera() {
  CameraModel model;
  model.width = 720;
  model.height = 480;
  model.fx = model.fy = 500.0;
  model.cx = 360.0;
  model.cy = 240.0;
  return model;
}

TEST(DistancesOf, AreWhereTheirPixelsLook) {
  const auto distances = distances_of({{{460.0, 190.0}, 0.25, 0.01, 0.0}}, camera());
  ASSERT_EQ(distances.size(), 1U);
  EXPECT_NEAR((distances[0].point - Eigen::Vector2d(0.2, -0.1)).norm(), 0.0, 1e-12);
  EXPECT_EQ(distances[0].distance.lambda, 0.25);
  EXPECT_NEAR(distances[0].distance.sigma, 0.01, 1e-15);
}

/// Sixteen of them, averaged by their own deviations, know no more than the pose that all share.
TEST(DistancesOf, KnowTogetherNoMoreThanTheWearersPose) {
  constexpr double kShared = 0.008;
  const std::vector<StereoDepth> depths(16, {{300.0, 200.0}, 0.25, 0.0, kShared});
  double information = 0.0;
  for (const auto& distance : distances_of(depths, camera()))
    information += 1.0 / (distance.distance.sigma * distance.distance.sigma);
  EXPECT_NEAR(std::sqrt(1.0 / information), kShared, 1e-12);
}

}  // namespace
}  // namespace cosight::robot
