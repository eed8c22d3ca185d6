#include "tools/prepare/pose_noise.hpp"

#include <gtest/gtest.h>

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

const PoseNoise kNoise{{0.01, 0.02, 0.03}, {0.001, 0.002, 0.004}};
const Pose kTrue{quaternion_exp({0.3, -0.2, 1.0}), {0.5, 0.1, 2.0}};

TEST(PoseNoise, HasTheStandardDeviationsThatItsCovarianceClaims) {
  PoseNoiseSource source(kNoise, 7);
  Eigen::Matrix<double, 6, 1> squares = Eigen::Matrix<double, 6, 1>::Zero();
  constexpr int kDraws = 4000;
  for (int i = 0; i < kDraws; ++i) {
    const UncertainPose observed = source.observe(kTrue);
    Eigen::Matrix<double, 6, 1> error;
    error << kTrue.p - observed.T.p, quaternion_log(kTrue.q * observed.T.q.conjugate());
    squares += error.cwiseAbs2() / kDraws;
    ASSERT_TRUE(is_valid(observed));
  }
  const auto claimed = PoseNoiseSource(kNoise, 1).observe(kTrue).covariance.diagonal().eval();
  for (int i = 0; i < 6; ++i)
    EXPECT_NEAR(squares(i) / claimed(i), 1.0, 0.1) << i;
}

TEST(PoseNoise, IsTheSameForTheSameSeedOnly) {
  PoseNoiseSource first(kNoise, 3);
  PoseNoiseSource again(kNoise, 3);
  PoseNoiseSource other(kNoise, 4);
  const UncertainPose observed = first.observe(kTrue);
  EXPECT_EQ(observed.T.p, again.observe(kTrue).T.p);
  EXPECT_NE(observed.T.p, other.observe(kTrue).T.p);
}

}  // namespace
}  // namespace cosight
