#include "shared/evaluation/association.hpp"

#include <gtest/gtest.h>

#include "tests/shared/evaluation/made_trajectory.hpp"

namespace cosight {
namespace {

StampedPose at(Stamp stamp, double x) {
  return {stamp, {Eigen::Quaterniond::Identity(), {x, 0.0, 0.0}}};
}

TEST(Association, TakesTheNearestInTimeWithinTheLimit) {
  const Trajectory estimate{at(100, 0), at(200, 0), at(300, 0)};
  const Trajectory truth{at(90, 1), at(104, 2), at(195, 3), at(350, 4)};
  const std::vector<PosePair> pairs = associate(estimate, truth, 10);
  ASSERT_EQ(pairs.size(), 2U);
  EXPECT_EQ(pairs[0].T_WC_truth.p.x(), 2.0);
  EXPECT_EQ(pairs[1].T_WC_truth.p.x(), 3.0);
  EXPECT_EQ(pairs[1].stamp, 200);
}

TEST(Association, UsesATruePoseForTheNearerOfTwoEstimatesOnly) {
  const Trajectory estimate{at(96, 0), at(101, 1), at(107, 2)};
  const Trajectory truth{at(100, 5)};
  const std::vector<PosePair> pairs = associate(estimate, truth, 10);
  ASSERT_EQ(pairs.size(), 1U);
  EXPECT_EQ(pairs[0].T_WC_estimate.p.x(), 1.0);
}

TEST(Association, AddsTheOffsetToTheTruth) {
  const Trajectory estimate{at(1000, 0)};
  EXPECT_TRUE(associate(estimate, {at(710, 1)}, 10).empty());
  EXPECT_EQ(associate(estimate, {at(710, 1)}, 10, 290).size(), 1U);
}

TEST(Association, OfNothingIsEmpty) {
  EXPECT_TRUE(associate({}, {at(1, 0)}, 10).empty());
  EXPECT_TRUE(associate({at(1, 0)}, {}, 10).empty());
}

TEST(PathLength, IsTheSumOfTheSteps) {
  EXPECT_NEAR(path_length(straight_line(11, 0.5)), 5.0, 1e-12);
}

}  // namespace
}  // namespace cosight
