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

/// 30 % wrong matches, told from the right ones as slam does it.
TEST(PoseConsistency, AverageNeesIsInsideItsBandWithWrongMatchesAsWell) {
  RunOptions options;
  options.validation = Validation::kHohctThenEach;
  options.wrong.share = 0.3;
  EXPECT_GE(figures_of(monte_carlo(options, kRuns)).pose_in_band, 0.9);
}

RunOptions with_error_of_T_SF(double sigma_p, double sigma_theta, double time) {
  RunOptions options;
  options.world.wearer_sigma_p = sigma_p;
  options.world.wearer_sigma_theta = sigma_theta;
  options.world.wearer_error_time = time;
  return options;
}

/// 5 cm and 2 degrees, new in every frame.
TEST(PoseConsistency, AWideErrorOfTheFreeCamerasPoseIsConsistentAndSmallerAsAState) {
  RunOptions options = with_error_of_T_SF(0.05, 0.035, 0.0);
  const ConsistencyCourse as_noise = monte_carlo(options, kRuns);
  options.filter.rig_error.is_state = true;
  options.filter.max_iterations = 4;
  const ConsistencyCourse as_state = monte_carlo(options, kRuns);
  EXPECT_LT(figures_of(as_noise).pose_in_band, 0.8);
  EXPECT_GE(figures_of(as_state).pose_in_band, 0.9);
  EXPECT_LT(mean_final_error(as_state), 0.85 * mean_final_error(as_noise));
}

/// 2 cm and 0.3 degrees that wander within 3 s: as noise each frame counts as new evidence.
TEST(PoseConsistency, AWanderingErrorOfTheFreeCamerasPoseIsOverconfidentUnlessItIsAState) {
  RunOptions options = with_error_of_T_SF(0.02, 0.005, 3.0);
  EXPECT_GT(figures_of(monte_carlo(options, kRuns)).pose_nees, 12.0);
  options.filter.rig_error = {true, 3.0, 0.0};
  EXPECT_LT(figures_of(monte_carlo(options, kRuns)).pose_nees, 7.0);
}

TEST(PoseConsistency, SameSeedIsTheSameRun) {
  ConsistencyRun a(7, {});
  ConsistencyRun b(7, {});
  for (int i = 0; i < 10; ++i)
    EXPECT_EQ(a.step().pose_nees, b.step().pose_nees);
}

}  // namespace
}  // namespace cosight::experiments
