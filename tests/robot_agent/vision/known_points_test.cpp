#include "robot_agent/vision/known_points.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>
#include <vector>

#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vision/synthetic_plane.hpp"

namespace cosight::vision {
namespace {

struct Sighting {
  Pose T_WC;
  std::vector<KnownPoint> points;
};

/// `n` points in front of a distorted camera in a random place; on one plane if wanted.
Sighting draw_sighting(std::mt19937& random, int n, double sigma_pixel, bool planar) {
  const CameraModel camera = slam_camera();
  std::uniform_real_distribution<double> unit(-1.0, 1.0);
  std::normal_distribution<double> noise(0.0, sigma_pixel);
  const auto draw3 = [&] { return Eigen::Vector3d(unit(random), unit(random), unit(random)); };
  Sighting sighting;
  sighting.T_WC = {quaternion_exp(3.0 * draw3()), 5.0 * draw3()};
  while (static_cast<int>(sighting.points.size()) < n) {
    const Eigen::Vector2d pixel(188.0 + 160.0 * unit(random), 128.0 + 100.0 * unit(random));
    const Eigen::Vector3d ray = *camera.unproject(pixel);
    const double depth = planar ? 2.0 / (1.0 + 0.3 * ray.x() - 0.2 * ray.y()) : 2.0 + unit(random);
    sighting.points.push_back(
        {sighting.T_WC * (depth * ray), pixel + Eigen::Vector2d(noise(random), noise(random))});
  }
  return sighting;
}

Eigen::Matrix<double, 6, 1> error_of(const Pose& estimate, const Pose& truth) {
  Eigen::Matrix<double, 6, 1> error;
  error << truth.p - estimate.p, quaternion_log(truth.q * estimate.q.conjugate());
  return error;
}

class KnownPoints : public testing::TestWithParam<bool> {};

TEST_P(KnownPoints, GiveTheExactPoseWithoutNoise) {
  std::mt19937 random(3);
  for (const int n : {4, 5, 12}) {
    const Sighting sighting = draw_sighting(random, n, 0.0, GetParam());
    const auto pose = estimate_pose(slam_camera(), sighting.points);
    ASSERT_TRUE(pose) << n;
    EXPECT_LT(error_of(pose->T_WC.T, sighting.T_WC).norm(), 1e-6);
    EXPECT_LT(pose->rms_error_px, 1e-6);
  }
}

TEST_P(KnownPoints, GiveACovarianceThatHoldsTheError) {
  std::mt19937 random(4);
  double nees = 0.0;
  constexpr int kRuns = 300;
  KnownPointsOptions options;
  options.sigma_pixel = 0.5;
  for (int run = 0; run < kRuns; ++run) {
    const Sighting sighting = draw_sighting(random, 12, 0.5, GetParam());
    const auto pose = estimate_pose(slam_camera(), sighting.points, options);
    ASSERT_TRUE(pose);
    const auto error = error_of(pose->T_WC.T, sighting.T_WC);
    nees += error.dot(pose->T_WC.covariance.ldlt().solve(error)) / kRuns;
  }
  // Mean of 300 chi-squared values of 6 degrees of freedom: 6 +- 0.2.
  EXPECT_NEAR(nees, 6.0, 0.6);
}

TEST_P(KnownPoints, AreFoundAmongFortyPercentWrongOnes) {
  std::mt19937 random(5);
  for (int run = 0; run < 20; ++run) {
    Sighting sighting = draw_sighting(random, 30, 0.5, GetParam());
    for (std::size_t i = 0; i < 12; ++i)
      sighting.points[i].pixel.x() += (i % 2 == 0 ? 40.0 : -60.0);
    const auto pose = estimate_pose_ransac(slam_camera(), sighting.points);
    ASSERT_TRUE(pose);
    EXPECT_EQ(pose->inlier_count, 18);
    for (std::size_t i = 0; i < 30; ++i)
      EXPECT_EQ(pose->inliers[i], i >= 12);
    EXPECT_LT(error_of(pose->T_WC.T, sighting.T_WC).head<3>().norm(), 0.05);
  }
}

INSTANTIATE_TEST_SUITE_P(PlanarOrNot, KnownPoints, testing::Bool());

TEST(KnownPointsRansac, GivesTheSameForTheSameSeed) {
  std::mt19937 random(6);
  Sighting sighting = draw_sighting(random, 30, 1.0, false);
  for (std::size_t i = 0; i < 10; ++i)
    sighting.points[i].pixel.y() += 50.0;
  const auto first = estimate_pose_ransac(slam_camera(), sighting.points);
  const auto second = estimate_pose_ransac(slam_camera(), sighting.points);
  ASSERT_TRUE(first && second);
  EXPECT_EQ(first->T_WC.T.p, second->T_WC.T.p);
  EXPECT_EQ(first->T_WC.T.q.coeffs(), second->T_WC.T.q.coeffs());
}

TEST(KnownPointsRansac, IsNothingForNoise) {
  std::mt19937 random(6);
  Sighting sighting = draw_sighting(random, 30, 0.0, false);
  const std::vector<KnownPoint> other = draw_sighting(random, 30, 0.0, false).points;
  for (std::size_t i = 0; i < 30; ++i)
    sighting.points[i].pixel = other[i].pixel;
  KnownPointsOptions options;
  options.min_inliers = 10;
  EXPECT_FALSE(estimate_pose_ransac(slam_camera(), sighting.points, options));
}

TEST(KnownPointsPose, IsNothingForTooFewOrDegeneratePoints) {
  std::mt19937 random(7);
  Sighting sighting = draw_sighting(random, 3, 0.0, false);
  EXPECT_FALSE(estimate_pose(slam_camera(), sighting.points));
  EXPECT_FALSE(estimate_pose_ransac(slam_camera(), sighting.points));
  const std::vector<KnownPoint> repeated(6, sighting.points.front());
  EXPECT_FALSE(estimate_pose(slam_camera(), repeated));
  EXPECT_FALSE(estimate_pose_ransac(slam_camera(), repeated));
  std::vector<KnownPoint> on_a_line;
  for (int i = 0; i < 6; ++i) {
    const Eigen::Vector3d p_W(-0.5 + 0.2 * i, 0.1, 2.0 + 0.1 * i);
    on_a_line.push_back({p_W, *slam_camera().project(p_W)});
  }
  EXPECT_FALSE(estimate_pose(slam_camera(), on_a_line));
}

}  // namespace
}  // namespace cosight::vision
