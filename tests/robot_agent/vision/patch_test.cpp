#include "robot_agent/vision/patch.hpp"

#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "robot_agent/vision/patch_warp.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vision/synthetic_plane.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {
namespace {

constexpr int kSide = 13;

TEST(PredictedWarp, MakesThePatchLookAsInTheOtherCamera) {
  const CameraModel camera_S = slam_camera();
  const CameraModel camera_F = worn_camera();
  const View reference{camera_S, Pose{}};
  const Eigen::Vector3d p_W(0.25, -0.1, 2.0);
  const TexturedPlane plane{p_W, p_W.normalized(), SyntheticTexture(21, 5.0)};
  const ReferencePatch first = cut_reference(plane.seen_from(reference), *camera_S.project(p_W));
  double least = 1.0;
  double least_unwarped = 1.0;
  for (const double roll : {-0.6, 0.0, 0.5}) {
    for (const double side : {-0.8, 0.0, 0.7}) {
      const Eigen::Vector3d centre(side, 0.1, 0.3);
      const View present{
          camera_F, {quaternion_exp({0.0, -0.4 * side, 0.0}) * quaternion_exp({0.0, 0.0, roll}), centre}};
      const auto pixel = camera_F.project(present.T_WC.inverse() * p_W);
      ASSERT_TRUE(pixel);
      const Patch seen = cut_patch(plane.seen_from(present), *pixel, kSide);
      const auto A = predicted_warp(reference, present, p_W);
      ASSERT_TRUE(A);
      least = std::min(least, zncc(*warp(first, *A, kSide), seen));
      least_unwarped = std::min(least_unwarped, zncc(*warp(first, Eigen::Matrix2d::Identity(), kSide), seen));
    }
  }
  EXPECT_GT(least, 0.97);
  EXPECT_LT(least_unwarped, 0.7) << "the views do not differ enough to test anything";
}

TEST(PredictedWarp, IsTheDerivativeOfThePlanesMapBetweenTheImages) {
  const CameraModel camera_S = slam_camera();
  const CameraModel camera_F = worn_camera();
  const View reference{camera_S, {quaternion_exp({0.1, 0.2, 0.05}), {0.1, 0.0, -0.2}}};
  const View present{camera_F, {quaternion_exp({-0.1, 0.1, 0.3}), {0.4, 0.1, 0.1}}};
  const Eigen::Vector3d p_W(0.5, -0.2, 3.0);
  const auto A = predicted_warp(reference, present, p_W);
  ASSERT_TRUE(A);
  const Eigen::Vector2d u = *camera_S.project(reference.T_WC.inverse() * p_W);
  const Eigen::Vector3d n_W = (p_W - reference.T_WC.p).normalized();
  const auto map = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d ray_W = reference.T_WC.q * *camera_S.unproject(pixel);
    const double depth = n_W.dot(p_W - reference.T_WC.p) / n_W.dot(ray_W);
    return *camera_F.project(present.T_WC.inverse() * (reference.T_WC.p + depth * ray_W));
  };
  constexpr double kStep = 1e-3;
  for (int k = 0; k < 2; ++k) {
    const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(k);
    const Eigen::Vector2d column = (map(u + step) - map(u - step)) / (2.0 * kStep);
    EXPECT_LT((column - A->col(k)).norm(), 1e-5);
  }
}

TEST(PredictedWarp, OfTheSameViewIsIdentity) {
  const CameraModel camera = slam_camera();
  const View view{camera, {quaternion_exp({0.1, 0.2, 0.3}), {1.0, 2.0, 3.0}}};
  const Eigen::Vector3d p_W = view.T_WC * Eigen::Vector3d(0.3, 0.2, 1.5);
  const auto A = predicted_warp(view, view, p_W);
  ASSERT_TRUE(A);
  EXPECT_TRUE(A->isIdentity(1e-9));
}

// Both cameras look along a corridor's wall (y = 1 in W, x ahead): pixels of the wall are mapped by geometry.
TEST(PredictedWarp, OfAGivenPlaneFollowsItsPixels) {
  const CameraModel camera_S = slam_camera();
  const CameraModel camera_F = worn_camera();
  const Eigen::Quaterniond ahead(0.5, -0.5, 0.5, -0.5);
  const View reference{camera_S, {ahead, {0.0, 0.0, 0.0}}};
  const View present{camera_F, {ahead, {0.8, 0.3, 0.1}}};
  const Eigen::Vector3d p_W(5.0, 1.0, 0.2);
  const Eigen::Vector2d u = *camera_S.project(reference.T_WC.inverse() * p_W);
  const auto map = [&](const Eigen::Vector2d& pixel) {
    const Eigen::Vector3d ray_W = reference.T_WC.q * *camera_S.unproject(pixel);
    return *camera_F.project(present.T_WC.inverse() * Eigen::Vector3d(ray_W / ray_W.y()));
  };
  for (const double sign : {1.0, -1.0}) {
    const auto A = predicted_warp(reference, present, p_W, Eigen::Vector3d(0.0, sign, 0.0));
    ASSERT_TRUE(A);
    constexpr double kStep = 1e-3;
    for (int k = 0; k < 2; ++k) {
      const Eigen::Vector2d step = kStep * Eigen::Vector2d::Unit(k);
      const Eigen::Vector2d column = (map(u + step) - map(u - step)) / (2.0 * kStep);
      EXPECT_LT((column - A->col(k)).norm(), 1e-5);
    }
  }
}

TEST(Surfaces, AreUnitNormalsOfWallsFloorAndWhatFacesTheCamera) {
  const Eigen::Vector3d up(0.0, -1.0, 0.0);
  const Eigen::Vector3d ray(0.4, 0.1, 2.0);
  const auto normals = surfaces_along(ray, up);
  EXPECT_TRUE(normals[0].isApprox(ray.normalized()));
  EXPECT_TRUE(normals[3].isApprox(up));
  for (const Eigen::Vector3d& normal : normals)
    EXPECT_NEAR(normal.norm(), 1.0, 1e-12);
  EXPECT_NEAR(normals[1].dot(up), normals[0].dot(up), 1e-12);  // turned about the vertical
  EXPECT_LT(normals[1].dot(normals[2]), 0.0);
}

TEST(PredictedWarp, IsRefusedBehindACameraAndEdgeOn) {
  const CameraModel camera = worn_camera();
  const View reference{camera, Pose{}};
  EXPECT_FALSE(predicted_warp(reference, {camera, {Eigen::Quaterniond::Identity(), {0, 0, 5}}}, {0, 0, 2}));
  EXPECT_FALSE(predicted_warp(reference, {camera, {Eigen::Quaterniond::Identity(), {0, 0, -5}}}, {0, 0, -2}));
  const Pose from_the_side{quaternion_exp({0.0, -M_PI / 2, 0.0}), {2.0, 0.0, 2.0}};
  EXPECT_FALSE(predicted_warp(reference, {camera, from_the_side}, {0, 0, 2}));
  const Eigen::Vector3d half_way(-1.0, 0.0, 1.0);
  EXPECT_TRUE(predicted_warp(reference, {camera, from_the_side}, {0, 0, 2}, half_way.normalized()));
}

TEST(Warp, IsRefusedWhereItMirrorsOrScalesTooMuch) {
  const ReferencePatch reference = cut_reference(SyntheticTexture(1).render(60, 60), {30, 30});
  EXPECT_TRUE(warp(reference, Eigen::Matrix2d::Identity(), kSide));
  EXPECT_FALSE(warp(reference, Eigen::Vector2d(-1.0, 1.0).asDiagonal(), kSide));
  EXPECT_FALSE(warp(reference, 5.0 * Eigen::Matrix2d::Identity(), kSide));
  EXPECT_FALSE(warp(reference, 0.2 * Eigen::Matrix2d::Identity(), kSide));
  EXPECT_FALSE(warp(reference, Eigen::Matrix2d::Constant(NAN), kSide));
}

TEST(Patch, CorrelatesFullyWithItselfUnderOtherLight) {
  const SyntheticTexture texture(2);
  const GrayImage image = texture.render(60, 60);
  GrayImage darker = image;
  for (auto& gray : darker.data)
    gray = static_cast<std::uint8_t>(gray / 2 + 20);
  const Patch a = cut_patch(image, {30, 30}, kSide);
  EXPECT_NEAR(zncc(a, a), 1.0, 1e-12);
  EXPECT_GT(zncc(a, cut_patch(darker, {30, 30}, kSide)), 0.999);
  EXPECT_LT(zncc(a, cut_patch(image, {37, 30}, kSide)), 0.7);
}

TEST(Patch, OfOneGrayLevelIsFlat) {
  const GrayImage gray{40, 40, std::vector<std::uint8_t>(1600, 77)};
  EXPECT_TRUE(cut_patch(gray, {20, 20}, kSide).is_flat());
  EXPECT_FALSE(cut_patch(SyntheticTexture(2).render(40, 40), {20, 20}, kSide).is_flat());
}

}  // namespace
}  // namespace cosight::vision
