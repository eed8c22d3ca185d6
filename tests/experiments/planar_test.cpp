#include <gtest/gtest.h>

#include <limits>

#include "experiments/planar/study.hpp"

namespace cosight::experiments {
namespace {

/// Linear enough for a filter with right Jacobians to be consistent: position NEES averages 2.
TEST(PlanarFilter, IsConsistentWhereTheNoiseIsSmall) {
  TrialOptions options;
  options.world.bearing_sigma_deg = 0.002;
  options.world.stereo_bearing_sigma_deg = 0.02;
  options.world.range_sigma = 0.002;
  options.world.duration = 15.0;
  options.world.path = 7.0;
  options.filter.sigma_acceleration = 2.0;
  options.filter.sigma_angular_acceleration = 2.0;
  options.known_sigma = 1e-5;
  constexpr int kRuns = 8;
  constexpr std::size_t kAfter = 20;
  double sum = 0.0;
  double count = 0.0;
  for (const TrialResult& trial : run_trials(options, 1, kRuns)) {
    for (std::size_t k = kAfter; k < trial.steps.size(); ++k) {
      sum += trial.steps[k].position_nees;
      count += 1.0;
    }
  }
  EXPECT_GT(sum / count, 1.0);
  EXPECT_LT(sum / count, 3.0);
}

TEST(PlanarSimulation, TwoShortOverlapsHalveTheFinalError) {
  constexpr int kRuns = 6;
  TrialOptions options;
  const MeanCourse collaborative = mean_course(run_trials(options, 1, kRuns));
  options.collaborative = false;
  const MeanCourse mono = mean_course(run_trials(options, 1, kRuns));
  EXPECT_LE(collaborative.position_error.back(), 0.5 * mono.position_error.back());
  EXPECT_LE(collaborative.scale_error.back(), 0.5 * mono.scale_error.back());
  const std::size_t before_first_overlap = 75;
  EXPECT_EQ(collaborative.position_error[before_first_overlap], mono.position_error[before_first_overlap]);
}

TEST(PlanarSimulation, FiguresCountARunThatEndsHalfThePathAwayAsDiverged) {
  WallWorldOptions world;
  TrialResult good;
  good.steps.resize(2);
  TrialResult lost = good;
  lost.steps.back().position_error = 0.6 * world.path;
  EXPECT_FALSE(is_diverged(good, world));
  EXPECT_TRUE(is_diverged(lost, world));
  lost.steps.back().position_error = std::numeric_limits<double>::quiet_NaN();
  EXPECT_TRUE(is_diverged(lost, world));
}

TEST(Correlation, IsOneForALineAndZeroForASymmetricBend) {
  EXPECT_NEAR(correlation({1.0, 2.0, 3.0}, {5.0, 7.0, 9.0}), 1.0, 1e-12);
  EXPECT_NEAR(correlation({-1.0, 0.0, 1.0}, {1.0, 0.0, 1.0}), 0.0, 1e-12);
}

TEST(Figures, JsonNestsGroupsAndKeepsWholeNumbersWhole) {
  Figures figures;
  figures.set("rank", "none", 8.0);
  figures.set("mono", "error", 0.5);
  EXPECT_EQ(figures.json(),
            "{\n  \"rank\": {\n    \"none\": 8\n  },\n  \"mono\": {\n    \"error\": 0.5\n  }\n}\n");
}

}  // namespace
}  // namespace cosight::experiments
