#include "shared/evaluation/trajectory_errors.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "tests/shared/evaluation/made_trajectory.hpp"

namespace cosight {
namespace {

using testing::DoubleNear;
using testing::Each;
using testing::ElementsAre;
using testing::SizeIs;

TEST(ErrorStatistics, OfAKnownListAreThoseDoneByHand) {
  const ErrorStatistics statistics = statistics_of({3.0, 1.0, 4.0, 0.0});
  EXPECT_EQ(statistics.count, 4U);
  EXPECT_NEAR(statistics.rmse, std::sqrt(26.0 / 4.0), 1e-12);
  EXPECT_NEAR(statistics.mean, 2.0, 1e-12);
  EXPECT_NEAR(statistics.median, 2.0, 1e-12);
  EXPECT_EQ(statistics.max, 4.0);
  EXPECT_EQ(statistics_of({}).count, 0U);
}

TEST(Quantile, InterpolatesBetweenNeighbours) {
  EXPECT_NEAR(quantile({10.0, 0.0, 20.0}, 0.25), 5.0, 1e-12);
  EXPECT_NEAR(quantile({10.0, 0.0, 20.0}, 1.0), 20.0, 1e-12);
}

TEST(PositionErrors, AreDistancesAndTheirPathIsTheTruths) {
  const Trajectory truth = straight_line(5, 2.0);
  const auto pairs = pairs_of(mapped(truth, 1.0, {Eigen::Quaterniond::Identity(), {0, 3, 4}}), truth);
  EXPECT_THAT(position_errors(pairs), ElementsAre(5, 5, 5, 5, 5));
  EXPECT_NEAR(true_path_length(pairs), 8.0, 1e-12);
}

TEST(RotationErrors, AreTheAngleBetween) {
  const Trajectory truth = spiral(5);
  Trajectory estimate = truth;
  for (StampedPose& pose : estimate)
    pose.T_WC.q = pose.T_WC.q * quaternion_exp({0.0, 0.3, 0.4});
  EXPECT_THAT(rotation_errors(pairs_of(estimate, truth)), Each(DoubleNear(0.5, 1e-9)));
}

TEST(RelativeErrors, DoNotSeeWhereTheWorldLies) {
  std::mt19937 random(3);
  const Trajectory truth = spiral(30);
  const RelativeErrors errors =
      relative_errors(pairs_of(mapped(truth, 1.0, random_pose(random, 9.0)), truth), {});
  EXPECT_THAT(errors.translation, SizeIs(29));
  EXPECT_THAT(errors.translation, Each(DoubleNear(0.0, 1e-9)));
  EXPECT_THAT(errors.rotation, Each(DoubleNear(0.0, 1e-7)));
}

TEST(RelativeErrors, OfAScaleErrorGrowWithTheDelta) {
  const Trajectory truth = straight_line(21, 0.5);
  const auto pairs = pairs_of(mapped(truth, 1.1, {}), truth);
  EXPECT_THAT(relative_errors(pairs, {}).translation, Each(DoubleNear(0.05, 1e-9)));
  const RelativeErrors tens = relative_errors(pairs, {.delta = 10.0});
  EXPECT_THAT(tens.translation, SizeIs(2)) << "consecutive intervals";
  EXPECT_THAT(tens.translation, Each(DoubleNear(0.5, 1e-9)));
  EXPECT_THAT(relative_errors(pairs, {.delta = 10.0, .all_pairs = true}).translation, SizeIs(11));
}

TEST(RelativeErrors, InMetresAndSecondsEndAtTheFirstPoseFarEnough) {
  const Trajectory truth = straight_line(21, 0.5);  // 10 Hz: 5 m/s
  const auto pairs = pairs_of(mapped(truth, 1.1, {}), truth);
  EXPECT_THAT(relative_errors(pairs, {2.0, DeltaUnit::kMetres, false}).translation,
              ElementsAre(DoubleNear(0.2, 1e-9), DoubleNear(0.2, 1e-9), DoubleNear(0.2, 1e-9),
                          DoubleNear(0.2, 1e-9), DoubleNear(0.2, 1e-9)));
  EXPECT_THAT(relative_errors(pairs, {0.95, DeltaUnit::kSeconds, false}).translation,
              ElementsAre(DoubleNear(0.5, 1e-9), DoubleNear(0.5, 1e-9)));
}

TEST(RelativeErrors, OfOneTurnIsSeenInOneIntervalOnly) {
  const Trajectory truth = straight_line(10, 1.0);
  Trajectory estimate = truth;
  for (std::size_t i = 5; i < estimate.size(); ++i) {
    estimate[i].T_WC = estimate[5].T_WC * Pose{quaternion_exp({0, 0, 0.2}), Eigen::Vector3d::Zero()} *
                       estimate[5].T_WC.inverse() * truth[i].T_WC;
  }
  const RelativeErrors errors = relative_errors(pairs_of(estimate, truth), {});
  for (std::size_t i = 0; i < errors.rotation.size(); ++i) {
    EXPECT_NEAR(errors.rotation[i], i == 4 ? 0.2 : 0.0, 1e-7) << i;
  }
}

}  // namespace
}  // namespace cosight
