#include "shared/geometry/camera_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <random>

namespace cosight {
namespace {

CameraModel euroc() {
  return {458.654,
          457.296,
          367.215,
          248.375,
          752,
          480,
          Distortion::kRadtan,
          {-0.28340811, 0.07395907, 0.00019359, 1.76187114e-05, 0.0}};
}
CameraModel fisheye() {
  return {
      260.9, 260.9, 254.9, 256.8, 512, 512, Distortion::kEquidistant, {0.0034, 0.0007, -0.0020, 0.0002, 0.0}};
}
CameraModel scenelib() {
  return {195.0, 195.0, 162.0, 125.0, 320, 240, Distortion::kScenelibWide, {9.0e-6, 0.0, 0.0, 0.0, 0.0}};
}
CameraModel pinhole() {
  return {718.856, 718.856, 607.1928, 185.2157, 1241, 376, Distortion::kNone, {}};
}

class EveryCamera : public testing::TestWithParam<CameraModel> {};

TEST_P(EveryCamera, ProjectsBackToTheSamePixelAllOverTheImage) {
  const CameraModel camera = GetParam();
  for (int v = 0; v < camera.height; v += 20) {
    for (int u = 0; u < camera.width; u += 20) {
      const auto ray = camera.unproject(Eigen::Vector2d(u, v));
      ASSERT_TRUE(ray) << u << ' ' << v;
      const auto pixel = camera.project(3.7 * *ray);
      ASSERT_TRUE(pixel);
      EXPECT_LT((*pixel - Eigen::Vector2d(u, v)).norm(), 1e-6);
    }
  }
}

TEST_P(EveryCamera, JacobiansMatchCentralDifferences) {
  const CameraModel camera = GetParam();
  std::mt19937 rng(7);
  std::uniform_real_distribution<double> unit(0.05, 0.95);
  for (int n = 0; n < 50; ++n) {
    const Eigen::Vector2d pixel(unit(rng) * camera.width, unit(rng) * camera.height);
    Eigen::Matrix<double, 3, 2> J_ray;
    const Eigen::Vector3d p_C = 2.5 * camera.unproject(pixel, &J_ray).value();
    Eigen::Matrix<double, 2, 3> J;
    ASSERT_TRUE(camera.project(p_C, &J));
    for (int i = 0; i < 3; ++i) {
      const Eigen::Vector3d step = 1e-6 * Eigen::Vector3d::Unit(i);
      const Eigen::Vector2d slope = (*camera.project(p_C + step) - *camera.project(p_C - step)) / 2e-6;
      EXPECT_LT((J.col(i) - slope).norm(), 1e-4);
    }
    for (int i = 0; i < 2; ++i) {
      const Eigen::Vector2d step = 1e-4 * Eigen::Vector2d::Unit(i);
      const Eigen::Vector3d slope =
          (*camera.unproject(pixel + step) - *camera.unproject(pixel - step)) / 2e-4;
      EXPECT_LT((J_ray.col(i) - slope).norm(), 1e-6);
    }
  }
}

INSTANTIATE_TEST_SUITE_P(Cameras, EveryCamera, testing::Values(euroc(), fisheye(), scenelib(), pinhole()));

TEST(CameraModel, EquidistantAngleIsProportionalToTheRadius) {
  const CameraModel camera{100.0, 100.0, 0.0, 0.0, 400, 400, Distortion::kEquidistant, {}};
  EXPECT_NEAR(camera.project({std::tan(0.8), 0.0, 1.0})->x(), 80.0, 1e-9);
}

TEST(CameraModel, SeesNothingBehindItself) {
  EXPECT_FALSE(pinhole().project({0.1, 0.1, -1.0}));
  EXPECT_FALSE(pinhole().project({0.1, 0.1, 0.0}));
  EXPECT_FALSE(pinhole().project(
      {std::numeric_limits<double>::quiet_NaN(), 0.0, std::numeric_limits<double>::quiet_NaN()}));
}

TEST(CameraModel, RefusesRaysWhereTheDistortionFoldsBack) {
  CameraModel camera = euroc();
  camera.coefficients = {-0.3, 0.01, 0.0, 0.0, 0.0};
  EXPECT_TRUE(camera.project({0.9, 0.0, 1.0}));
  EXPECT_FALSE(camera.project({1.5, 0.0, 1.0}));
}

}  // namespace
}  // namespace cosight
