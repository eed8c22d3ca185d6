#include "robot_agent/overlap/predict_overlap.hpp"

#include <gtest/gtest.h>

#include <Eigen/Cholesky>
#include <cmath>
#include <random>

#include "shared/geometry/convex_polygon.hpp"
#include "shared/geometry/rotation.hpp"

namespace cosight::overlap {
namespace {

constexpr double kDegree = M_PI / 180.0;

CameraModel pinhole() {
  return {500.0, 500.0, 319.5, 239.5, 640, 480, Distortion::kNone, {}};
}

CameraModel euroc_like() {
  CameraModel camera{458.0, 457.0, 367.0, 248.0, 752, 480, Distortion::kRadtan, {}};
  camera.coefficients = {-0.28, 0.07, 0.0002, 0.00002, 0.0};
  return camera;
}

UncertainPose beside(double baseline, double yaw, double sigma_p, double sigma_theta) {
  UncertainPose T_SF;
  T_SF.T = {quaternion_exp({0.0, yaw, 0.0}), {baseline, 0.0, 0.0}};
  T_SF.covariance.diagonal() << Eigen::Vector3d::Constant(sigma_p * sigma_p),
      Eigen::Vector3d::Constant(sigma_theta * sigma_theta);
  return T_SF;
}

/// Pinhole and Brown-Conrady written out again, by OpenCV's documentation; nothing behind the camera.
bool sees(const CameraModel& camera, const Eigen::Vector3d& p_C, Eigen::Vector2d& pixel) {
  if (p_C.z() <= 0.0) return false;
  const double x = p_C.x() / p_C.z();
  const double y = p_C.y() / p_C.z();
  if (std::hypot(x, y) > 1.3) return false;
  const auto& [k1, k2, p1, p2, k3] = camera.coefficients;
  const double r2 = x * x + y * y;
  const double radial = 1.0 + k1 * r2 + k2 * r2 * r2 + k3 * r2 * r2 * r2;
  pixel.x() = camera.fx * (x * radial + 2 * p1 * x * y + p2 * (r2 + 2 * x * x)) + camera.cx;
  pixel.y() = camera.fy * (y * radial + p1 * (r2 + 2 * y * y) + 2 * p2 * x * y) + camera.cy;
  return camera.contains(pixel);
}

struct Coverage {
  int seen_by_both = 0;
  int inside_both_regions = 0;
};

/// Points drawn in Cs's view up to the far depth, seen by a Cf whose true pose is drawn from the covariance.
Coverage sample_coverage(const CameraModel& camera_S, const CameraModel& camera_F, const UncertainPose& T_SF,
                         const OverlapEstimate& overlap, const OverlapOptions& options, unsigned seed) {
  std::mt19937 random(seed);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  std::normal_distribution<double> normal;
  const Eigen::Matrix<double, 6, 1> sigma = T_SF.covariance.diagonal().cwiseSqrt();
  Coverage coverage;
  for (int i = 0; i < 100000; ++i) {
    const Eigen::Vector2d pixel_S(unit(random) * (camera_S.width - 1), unit(random) * (camera_S.height - 1));
    const double z = options.near + unit(random) * (overlap.far_depth - options.near);
    const Eigen::Vector3d p_S = z * *camera_S.unproject(pixel_S);
    Eigen::Matrix<double, 6, 1> error;
    for (int k = 0; k < 6; ++k)
      error(k) = sigma(k) * normal(random);
    const Pose T_SF_true{quaternion_exp(error.tail<3>()) * T_SF.T.q, T_SF.T.p + error.head<3>()};
    const Eigen::Vector3d p_F = T_SF_true.inverse() * p_S;
    Eigen::Vector2d pixel_F;
    if (p_F.z() < options.near || p_F.z() > overlap.far_depth || !sees(camera_F, p_F, pixel_F)) continue;
    ++coverage.seen_by_both;
    if (contains(overlap.roi_in_S, pixel_S) && contains(overlap.roi_in_F, pixel_F))
      ++coverage.inside_both_regions;
  }
  return coverage;
}

class OverlapMonteCarlo : public testing::TestWithParam<double> {};

TEST_P(OverlapMonteCarlo, RegionsHoldAllThatBothCamerasSee) {
  const OverlapOptions options;
  for (const CameraModel& camera_F : {pinhole(), euroc_like()}) {
    const UncertainPose T_SF = beside(1.5, GetParam(), 0.0, 0.0);
    const OverlapEstimate overlap = predict_overlap(euroc_like(), camera_F, T_SF, options);
    ASSERT_TRUE(overlap.predicted);
    const Coverage coverage = sample_coverage(euroc_like(), camera_F, T_SF, overlap, options, 3);
    ASSERT_GT(coverage.seen_by_both, 100);
    EXPECT_GE(coverage.inside_both_regions, 0.998 * coverage.seen_by_both);
  }
}

TEST_P(OverlapMonteCarlo, RegionsHoldNearlyAllUnderPoseNoise) {
  const OverlapOptions options;
  const UncertainPose T_SF = beside(1.5, GetParam(), 0.05, 2.0 * kDegree);
  const OverlapEstimate overlap = predict_overlap(euroc_like(), pinhole(), T_SF, options);
  ASSERT_TRUE(overlap.predicted);
  const Coverage coverage = sample_coverage(euroc_like(), pinhole(), T_SF, overlap, options, 4);
  ASSERT_GT(coverage.seen_by_both, 100);
  EXPECT_GE(coverage.inside_both_regions, 0.98 * coverage.seen_by_both);
}

INSTANTIATE_TEST_SUITE_P(Yaws, OverlapMonteCarlo,
                         testing::Values(-60 * kDegree, -40 * kDegree, -10 * kDegree, 0.0, 20 * kDegree,
                                         30 * kDegree));

TEST(PredictOverlap, RegionIsNotLargerThanWhatIsSeen) {
  // Turned by 40 degrees away: the common part is a strip at the right of S and at the left of F.
  const OverlapOptions options;
  const OverlapEstimate overlap =
      predict_overlap(pinhole(), pinhole(), beside(0.2, 40 * kDegree, 0.0, 0.0), options);
  ASSERT_TRUE(overlap.predicted);
  const Rectangle in_S = bounding_box(overlap.roi_in_S);
  const Rectangle in_F = bounding_box(overlap.roi_in_F);
  // F's left edge ray is at 40 - atan(0.64) = 7.4 degrees in S; the offset of its centre moves it outwards.
  EXPECT_NEAR(in_S.min.x(), 319.5 + 500.0 * std::tan(7.4 * kDegree), 12.0);
  EXPECT_NEAR(in_S.max.x(), 639.0, 1.0);
  EXPECT_NEAR(in_F.min.x(), 0.0, 1.0);
  // S's right edge is at 32.6 degrees: 7.4 left of F's axis; near points lie further left.
  EXPECT_NEAR(in_F.max.x(), 319.5 - 500.0 * std::tan(7.4 * kDegree), 12.0);
}

TEST(PredictOverlap, IsNothingWhereTheViewsAreDisjoint) {
  EXPECT_FALSE(predict_overlap(pinhole(), pinhole(), beside(1.0, M_PI, 0.001, 0.001)).predicted);
  EXPECT_FALSE(predict_overlap(pinhole(), pinhole(), beside(1.0, 80 * kDegree, 0.001, 0.001)).predicted);
}

TEST(PredictOverlap, AllowsForThePosesUncertainty) {
  // 66 degrees apart and 65 degrees wide: disjoint by a degree, unless the yaw is off by 2 degrees.
  EXPECT_FALSE(predict_overlap(pinhole(), pinhole(), beside(0.5, 68 * kDegree, 0.0, 0.0)).predicted);
  const OverlapEstimate overlap =
      predict_overlap(pinhole(), pinhole(), beside(0.5, 68 * kDegree, 0.0, 3.0 * kDegree));
  EXPECT_TRUE(overlap.predicted);
  EXPECT_LT(covered_fraction(overlap.roi_in_S, pinhole()), 0.2);
}

TEST(PredictOverlap, OfOnePlaceIsNothingForWantOfParallax) {
  EXPECT_FALSE(predict_overlap(pinhole(), pinhole(), beside(0.0, 0.0, 0.0, 0.0)).predicted);
}

TEST(PredictOverlap, SideBySideIsNearlyTheWholeImage) {
  const OverlapEstimate overlap =
      predict_overlap(pinhole(), pinhole(), beside(0.5, 0.0, 0.01, 0.05 * kDegree));
  ASSERT_TRUE(overlap.predicted);
  EXPECT_NEAR(overlap.far_depth, 0.5 / (2.0 * std::tan(0.5 * kDegree)), 1e-9);
  EXPECT_GT(covered_fraction(overlap.roi_in_S, pinhole()), 0.95);
  EXPECT_GT(covered_fraction(overlap.roi_in_F, pinhole()), 0.95);
}

TEST(PredictOverlap, SurvivesPosesOfNoUse) {
  UncertainPose vague = beside(0.5, 0.3, 100.0, 10.0);
  EXPECT_NO_THROW(predict_overlap(pinhole(), euroc_like(), vague));
  vague.T.p = {0.0, 0.0, 1e6};
  EXPECT_NO_THROW(predict_overlap(pinhole(), euroc_like(), vague));
  vague.T.p.setConstant(NAN);
  EXPECT_FALSE(predict_overlap(pinhole(), euroc_like(), vague).predicted);
}

TEST(FarDepth, FollowsTheLeastParallaxWithinItsLimits) {
  const OverlapOptions options;
  EXPECT_DOUBLE_EQ(far_depth(0.0, options), options.near);
  EXPECT_DOUBLE_EQ(far_depth(1e3, options), options.far);
  const double depth = far_depth(0.5, options);
  EXPECT_NEAR(2.0 * std::atan(0.25 / depth), options.min_parallax_deg * kDegree, 1e-12);
}

}  // namespace
}  // namespace cosight::overlap
