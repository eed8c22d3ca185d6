// Monte Carlo: is the true pose as far from the estimate as the covariance says?
#include <gtest/gtest.h>

#include "experiments/consistency/monte_carlo.hpp"

namespace cosight::experiments {
namespace {

constexpr int kRuns = 50;

/// Two glances in ten seconds, new landmarks by parallax between them.
TEST(PoseConsistency, CollaborativeAverageNeesIsInsideItsBand) {
  const ConsistencyFigures c = figures_of(monte_carlo(RunOptions{}, kRuns));
  EXPECT_GE(c.pose_in_band, 0.9);
  EXPECT_GE(c.position_in_band, 0.9);
  EXPECT_NEAR(c.nis_joint, 1.0, 0.03);
  EXPECT_NEAR(c.nis_point, 1.0, 0.05);
}

TEST(PoseConsistency, MonoAverageNeesIsInsideItsBand) {
  RunOptions options;
  options.last_glance = 5;
  const ConsistencyFigures c = figures_of(monte_carlo(options, kRuns));
  EXPECT_GE(c.pose_in_band, 0.9);
  EXPECT_GE(c.position_in_band, 0.8);
}

TEST(PoseConsistency, OverconfidentFilterIsCaught) {
  RunOptions options;
  options.claimed_variance = 1.0 / 3.0;
  const ConsistencyFigures c = figures_of(monte_carlo(options, kRuns));
  EXPECT_LT(c.pose_in_band, 0.2);
  EXPECT_GT(c.pose_nees, 8.0);
  EXPECT_GT(c.nis_joint, 2.0);
}

/// The triangulated point, whatever its form, has a covariance that depends on its own error.
TEST(PoseConsistency, TriangulatedPointsAreMoreOverconfidentThanPixels) {
  RunOptions options;
  options.wearer_form = WearerForm::kPoint;
  const ConsistencyFigures inverse = figures_of(monte_carlo(options, kRuns));
  EXPECT_GT(inverse.pose_nees, 6.7);
  options.filter.point_form = ekf::PointForm::kEuclidean;
  EXPECT_GT(figures_of(monte_carlo(options, kRuns)).pose_nees, inverse.pose_nees);
}

/// The paper's R counts one error many times.
TEST(PoseConsistency, AnErrorTakenAsIndependentIsOverconfident) {
  RunOptions options;
  options.filter.correlated_wearer_pose = false;
  EXPECT_GT(figures_of(monte_carlo(options, kRuns)).pose_nees, 7.5);
}

TEST(PoseConsistency, LandmarksThatStartAsIndependentAreOverconfident) {
  RunOptions options;
  options.correlated_starts = false;
  EXPECT_GT(figures_of(monte_carlo(options, kRuns)).pose_nees, 7.5);
}

TEST(PoseConsistency, SameSeedIsTheSameRun) {
  ConsistencyRun a(7, {});
  ConsistencyRun b(7, {});
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(a.step().pose_nees, b.step().pose_nees);
}

}  // namespace
}  // namespace cosight::experiments
