#include "shared/evaluation/alignment.hpp"

#include <gtest/gtest.h>

#include "tests/shared/evaluation/made_trajectory.hpp"

namespace cosight {
namespace {

class AlignmentOfSeed : public testing::TestWithParam<unsigned> {
 protected:
  std::mt19937 random_{GetParam()};
};

TEST_P(AlignmentOfSeed, Sim3RecoversTheSimilarityThatWasApplied) {
  const Trajectory truth = spiral(60);
  const Pose T_estimate_truth = random_pose(random_, 10.0);
  const double scale = 0.3 + 0.5 * GetParam();
  const auto pairs = pairs_of(mapped(truth, scale, T_estimate_truth), truth);
  const std::optional<Similarity> similarity = align(pairs, Alignment::kSim3);
  ASSERT_TRUE(similarity.has_value());
  EXPECT_NEAR(similarity->scale, 1.0 / scale, 1e-9);
  for (const PosePair& pair : pairs) {
    const Pose T_WC = *similarity * pair.T_WC_estimate;
    EXPECT_LT((T_WC.p - pair.T_WC_truth.p).norm(), 1e-9);
    EXPECT_LT(T_WC.q.angularDistance(pair.T_WC_truth.q), 1e-7);
  }
}

TEST_P(AlignmentOfSeed, Se3IsTheBestOfItsNeighbours) {
  const Trajectory truth = spiral(60);
  Trajectory estimate = mapped(truth, 1.1, random_pose(random_, 3.0));
  std::normal_distribution<double> noise(0.0, 0.1);
  for (StampedPose& pose : estimate)
    pose.T_WC.p += Eigen::Vector3d(noise(random_), noise(random_), noise(random_));
  const auto pairs = pairs_of(estimate, truth);
  const auto cost = [&](const Similarity& similarity) {
    double sum = 0.0;
    for (const PosePair& pair : pairs)
      sum += ((similarity * pair.T_WC_estimate).p - pair.T_WC_truth.p).squaredNorm();
    return sum;
  };
  const Similarity best = align(pairs, Alignment::kSe3).value();
  EXPECT_EQ(best.scale, 1.0);
  for (int axis = 0; axis < 3; ++axis) {
    for (const double step : {-1e-3, 1e-3}) {
      Similarity turned = best;
      turned.T.q = quaternion_exp(step * Eigen::Vector3d::Unit(axis)) * best.T.q;
      Similarity moved = best;
      moved.T.p += step * Eigen::Vector3d::Unit(axis);
      EXPECT_GT(cost(turned), cost(best));
      EXPECT_GT(cost(moved), cost(best));
    }
  }
}

TEST_P(AlignmentOfSeed, FirstPoseLaysTheFirstPosesOnEachOtherAndKeepsTheScale) {
  const Trajectory truth = spiral(5);
  const auto pairs = pairs_of(mapped(truth, 2.0, random_pose(random_, 10.0)), truth);
  const Similarity similarity = align(pairs, Alignment::kFirstPose).value();
  const Pose T_WC = similarity * pairs[0].T_WC_estimate;
  EXPECT_LT((T_WC.p - truth[0].T_WC.p).norm(), 1e-12);
  EXPECT_LT(T_WC.q.angularDistance(truth[0].T_WC.q), 1e-7);
  EXPECT_EQ(similarity.scale, 1.0);
}

TEST_P(AlignmentOfSeed, TheEstimatedScaleIsThatOfTheEstimate) {
  const Trajectory truth = spiral(30);
  const auto pairs = pairs_of(mapped(truth, 1.02, random_pose(random_, 4.0)), truth);
  EXPECT_NEAR(estimated_scale(pairs).value(), 1.02, 1e-9);
}

INSTANTIATE_TEST_SUITE_P(Seeds, AlignmentOfSeed, testing::Range(1U, 5U));

TEST(Alignment, AMirroredEstimateIsTurnedNeverMirrored) {
  const Trajectory truth = spiral(30);
  Trajectory mirrored = truth;
  for (StampedPose& pose : mirrored)
    pose.T_WC.p.z() *= -1.0;
  const Similarity similarity = align(pairs_of(mirrored, truth), Alignment::kSe3).value();
  EXPECT_NEAR(similarity.T.q.toRotationMatrix().determinant(), 1.0, 1e-9);
}

TEST(Alignment, OfAStraightLineIsNotDeterminedButItsScaleIs) {
  const Trajectory truth = straight_line(20, 0.5);
  const auto pairs = pairs_of(mapped(truth, 1.5, {quaternion_exp({0.2, 0.4, 0.1}), {1, 2, 3}}), truth);
  EXPECT_FALSE(align(pairs, Alignment::kSe3).has_value());
  EXPECT_FALSE(align(pairs, Alignment::kSim3).has_value());
  EXPECT_NEAR(estimated_scale(pairs).value(), 1.5, 1e-9);
}

TEST(Alignment, OfACameraThatStoodStillIsNotDetermined) {
  const auto pairs = pairs_of(straight_line(9, 0.0), straight_line(9, 0.0));
  EXPECT_FALSE(align(pairs, Alignment::kSim3).has_value());
  EXPECT_FALSE(estimated_scale(pairs).has_value());
  EXPECT_TRUE(align(pairs, Alignment::kFirstPose).has_value());
}

TEST(Alignment, NamesGoBothWays) {
  for (const char* name : {"none", "first_pose", "se3", "sim3"}) {
    EXPECT_STREQ(to_string(alignment_from(name).value()), name);
  }
  EXPECT_FALSE(alignment_from("affine").has_value());
}

}  // namespace
}  // namespace cosight
