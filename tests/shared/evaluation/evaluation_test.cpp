#include "shared/evaluation/evaluation.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "shared/evaluation/evaluation_error.hpp"
#include "tests/shared/evaluation/made_trajectory.hpp"

namespace cosight {
namespace {

using testing::HasSubstr;
using testing::ThrowsMessage;

TEST(Evaluation, OfAnEstimateThatIsTwoPercentTooLarge) {
  const Trajectory truth = straight_line(101, 0.5);  // 50 m
  const Evaluation evaluation = evaluate(mapped(truth, 1.02, {}), truth, {});
  EXPECT_NEAR(evaluation.metric("path_m").value(), 50.0, 1e-9);
  EXPECT_NEAR(evaluation.metric("scale").value(), 1.02, 1e-9);
  EXPECT_NEAR(evaluation.metric("scale_error_percent").value(), 2.0, 1e-7);
  EXPECT_NEAR(evaluation.metric("path_length_error_percent").value(), 2.0, 1e-7);
  EXPECT_NEAR(evaluation.metric("final_error_m").value(), 1.0, 1e-9);
  EXPECT_NEAR(evaluation.metric("final_error_percent").value(), 2.0, 1e-9);
  EXPECT_NEAR(evaluation.metric("mean_error_m").value(), 0.5, 1e-9);
  EXPECT_NEAR(evaluation.metric("accumulated_error_m").value(), 50.5, 1e-9);
  EXPECT_NEAR(evaluation.metric("rpe_m").value(), 0.01, 1e-9);
  EXPECT_NEAR(evaluation.metric("coverage_percent").value(), 100.0, 1e-9);
}

TEST(Evaluation, TellsALateStartFromPosesThatAreMissing) {
  const Trajectory truth = straight_line(101, 0.5);
  Trajectory estimate(truth.begin() + 20, truth.end());
  EXPECT_NEAR(evaluate(estimate, truth, {}).metric("coverage_percent").value(), 100.0 * 81 / 101, 1e-9);
  EXPECT_NEAR(evaluate(estimate, truth, {}).metric("coverage_after_start_percent").value(), 100.0, 1e-9);
  estimate.erase(estimate.begin() + 10, estimate.begin() + 50);
  EXPECT_NEAR(evaluate(estimate, truth, {}).metric("coverage_after_start_percent").value(), 100.0 * 41 / 81,
              1e-9);
}

TEST(Evaluation, KeepsTheScaleErrorThatSim3Hides) {
  const Trajectory truth = spiral(50);
  EvaluationOptions options;
  options.alignment = Alignment::kSim3;
  const Evaluation evaluation = evaluate(mapped(truth, 0.5, {}), truth, options);
  EXPECT_NEAR(evaluation.metric("ate_m").value(), 0.0, 1e-9);
  EXPECT_NEAR(evaluation.metric("scale_error_percent").value(), 50.0, 1e-7);
}

TEST(Evaluation, SaysWhichAlignmentAStraightLineAllows) {
  EvaluationOptions options;
  options.alignment = Alignment::kSe3;
  EXPECT_THAT([&] { evaluate(straight_line(9, 1.0), straight_line(9, 1.0), options); },
              ThrowsMessage<EvaluationError>(HasSubstr("use 'first_pose' or 'none'")));
}

TEST(Evaluation, SaysWhichTimesDoNotMeet) {
  Trajectory late = spiral(5);
  for (StampedPose& pose : late)
    pose.stamp += 100 * kNanosecondsPerSecond;
  EXPECT_THAT(
      [&] { evaluate(late, spiral(5), {}); },
      ThrowsMessage<EvaluationError>(HasSubstr("the estimate covers 100.000000000 to 100.400000000 s")));
}

TEST(Evaluation, CountsFramesOnlyWhereThereAreAny) {
  const Trajectory truth = spiral(4);
  EXPECT_FALSE(evaluate(truth, truth, {}).metric("overlap_ratio").has_value());
  std::vector<FrameRecord> frames(4);
  for (std::size_t i = 0; i < frames.size(); ++i) {
    frames[i].stamp = truth[i].stamp;
    frames[i].pseudo_stereo = i < 2;
    frames[i].total_ms = static_cast<double>(i);
  }
  const Evaluation evaluation = evaluate(truth, truth, {}, frames);
  EXPECT_NEAR(evaluation.metric("overlap_ratio").value(), 0.5, 1e-9);
  EXPECT_NEAR(evaluation.metric("pseudo_stereo_share").value(), 0.5, 1e-9);
  EXPECT_NEAR(evaluation.metric("frame_ms_median").value(), 1.5, 1e-9);
  EXPECT_FALSE(evaluation.metric("tau").has_value());
}

TEST(Evaluation, TurnsTheCovariancesWithTheAlignment) {
  // GIVEN errors along x of the estimate's world only, and a covariance that says so
  const Trajectory truth = spiral(40);
  Trajectory estimate = mapped(truth, 1.0, {quaternion_exp({0, 0, 1.5}), {1, 2, 3}});
  CovarianceLog covariances;
  for (std::size_t i = 0; i < estimate.size(); ++i) {
    estimate[i].T_WC.p.x() += i % 2 == 0 ? 0.1 : -0.1;
    Eigen::Matrix<double, 6, 1> variances;
    variances << 1e-2, 1e-4, 1e-4, 1e-4, 1e-4, 1e-4;
    covariances[estimate[i].stamp] = variances.asDiagonal();
  }
  EvaluationOptions options;
  options.alignment = Alignment::kSe3;
  // THEN every normalised error is about (0.1 / 0.1)^2, which it would not be along the wrong axes
  EXPECT_NEAR(evaluate(estimate, truth, options, {}, covariances).metric("nees_mean").value(), 1.0, 0.3);
  options.alignment = Alignment::kSim3;
  EXPECT_LE(evaluate(estimate, truth, options, {}, covariances).metric("nees_share_within_95").value_or(0.0),
            1.0);
}

}  // namespace
}  // namespace cosight
