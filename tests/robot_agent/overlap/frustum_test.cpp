#include "robot_agent/overlap/frustum.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <vector>

#include "shared/geometry/rotation.hpp"

namespace cosight::overlap {
namespace {

Frustum square_frustum(double near_z, double far_z) {
  return {{{-0.5, -0.5}, {0.5, -0.5}, {0.5, 0.5}, {-0.5, 0.5}}, 0.0, near_z, far_z};
}

/// By the definition of a frustum, not by half-spaces.
bool is_seen(const Frustum& frustum, const Pose& T_AC, const Eigen::Vector3d& p_A) {
  const Eigen::Vector3d p_C = T_AC.inverse() * p_A;
  return p_C.z() >= frustum.near_z && p_C.z() <= frustum.far_z && std::abs(p_C.x()) <= 0.5 * p_C.z() &&
         std::abs(p_C.y()) <= 0.5 * p_C.z();
}

TEST(ImageRays, AreTheFourCornersWithoutDistortion) {
  const CameraModel camera{500.0, 500.0, 319.5, 239.5, 640, 480, Distortion::kNone, {}};
  const ConvexPolygon rays = image_rays(camera);
  ASSERT_EQ(rays.size(), 4U);
  const Rectangle box = bounding_box(rays);
  EXPECT_NEAR(box.max.x(), 0.64, 1e-12);
  EXPECT_NEAR(box.min.y(), -0.48, 1e-12);
}

TEST(ImageRays, HoldEveryPixelOfADistortedImage) {
  for (const double k1 : {-0.28, 0.1}) {
    CameraModel camera{458.0, 457.0, 367.0, 248.0, 752, 480, Distortion::kRadtan, {}};
    camera.coefficients = {k1, 0.07, 0.0002, 0.00002, 0.0};
    const ConvexPolygon rays = image_rays(camera);
    for (int x = 0; x < 752; x += 25) {
      for (int y = 0; y < 480; y += 25) {
        // The hull of eight rays may cut a sliver of a bulging edge.
        const Eigen::Vector2d ray = camera.unproject({x, y})->head<2>();
        EXPECT_TRUE(contains(rays, 0.98 * ray)) << x << " " << y << " k1 " << k1;
      }
    }
  }
}

class FrustumIntersection : public testing::TestWithParam<unsigned> {};

TEST_P(FrustumIntersection, HasExactlyTheExtremesOfTheSampledPoints) {
  std::mt19937 random(GetParam());
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  const Frustum a = square_frustum(0.5, 6.0);
  const Frustum b = square_frustum(0.3, 5.0);
  const Pose T_AB{quaternion_exp(0.8 * Eigen::Vector3d(unit(random), unit(random), unit(random))),
                  2.0 * Eigen::Vector3d(unit(random), unit(random), unit(random))};
  const std::vector<Eigen::Vector3d> corners = intersection_corners(to_body(a, Pose{}), to_body(b, T_AB));
  std::vector<Eigen::Vector3d> directions;
  directions.reserve(20);
  for (int i = 0; i < 20; ++i)
    directions.emplace_back(unit(random), unit(random), unit(random));
  std::vector<double> sampled(directions.size(), -1e9);
  int inside = 0;
  for (int i = 0; i < 100000; ++i) {
    const double z = 0.5 + 5.5 * std::cbrt(0.5 + 0.5 * unit(random));
    const Eigen::Vector3d p_A(0.5 * z * unit(random), 0.5 * z * unit(random), z);
    if (!is_seen(a, Pose{}, p_A) || !is_seen(b, T_AB, p_A)) continue;
    ++inside;
    for (std::size_t k = 0; k < directions.size(); ++k)
      sampled[k] = std::max(sampled[k], directions[k].dot(p_A));
  }
  if (inside == 0) {
    EXPECT_TRUE(corners.empty()) << "a body too small to be sampled is possible, but not for these seeds";
    return;
  }
  ASSERT_FALSE(corners.empty());
  for (std::size_t k = 0; k < directions.size(); ++k) {
    double extreme = -1e9;
    for (const Eigen::Vector3d& corner : corners)
      extreme = std::max(extreme, directions[k].dot(corner));
    EXPECT_GE(extreme, sampled[k] - 1e-6);
    if (inside > 1000) {
      EXPECT_LE(extreme, sampled[k] + 0.9);
    }
  }
  for (const Eigen::Vector3d& corner : corners) {
    const Eigen::Vector3d p_B = T_AB.inverse() * corner;
    EXPECT_GE(std::min(corner.z() - 0.5, p_B.z() - 0.3), -1e-6);
    EXPECT_LE(std::max(std::abs(corner.x()), std::abs(corner.y())), 0.5 * corner.z() + 1e-6);
    EXPECT_LE(std::max(std::abs(p_B.x()), std::abs(p_B.y())), 0.5 * p_B.z() + 1e-6);
  }
}

INSTANTIATE_TEST_SUITE_P(Seeds, FrustumIntersection, testing::Range(1U, 31U));

TEST(FrustumIntersectionDegenerate, OfABodyWithItselfIsTheBody) {
  const ConvexBody body = to_body(square_frustum(0.5, 4.0), Pose{});
  const auto corners = intersection_corners(body, body);
  ASSERT_FALSE(corners.empty());
  double far_z = 0.0;
  double near_z = 9.0;
  for (const Eigen::Vector3d& corner : corners) {
    far_z = std::max(far_z, corner.z());
    near_z = std::min(near_z, corner.z());
  }
  EXPECT_NEAR(far_z, 4.0, 1e-6);
  EXPECT_NEAR(near_z, 0.5, 1e-6);
}

TEST(FrustumIntersectionDegenerate, OfAContainedBodyIsThatBody) {
  const ConvexBody outer = to_body(square_frustum(0.5, 10.0), Pose{});
  const ConvexBody inner = to_body(square_frustum(0.5, 2.0), {Eigen::Quaterniond::Identity(), {0, 0, 4}});
  double far_z = 0.0;
  for (const Eigen::Vector3d& corner : intersection_corners(outer, inner)) {
    far_z = std::max(far_z, corner.z());
    EXPECT_GE(corner.z(), 4.5 - 1e-6);
  }
  EXPECT_NEAR(far_z, 6.0, 1e-6);
}

TEST(FrustumIntersectionDegenerate, IsEmptyBehindAndBackToBack) {
  const ConvexBody body = to_body(square_frustum(0.5, 4.0), Pose{});
  const Pose behind{Eigen::Quaterniond::Identity(), {0, 0, -5}};
  const Pose back_to_back{quaternion_exp({0.0, M_PI, 0.0}), Eigen::Vector3d::Zero()};
  EXPECT_TRUE(intersection_corners(body, to_body(square_frustum(0.5, 4.0), behind)).empty());
  EXPECT_TRUE(intersection_corners(body, to_body(square_frustum(0.5, 4.0), back_to_back)).empty());
  EXPECT_TRUE(intersection_corners(body, to_body(square_frustum(4.0, 4.0), Pose{})).empty());
}

}  // namespace
}  // namespace cosight::overlap
