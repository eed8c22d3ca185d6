#include "shared/geometry/uncertain_pose.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <random>

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

TEST(UncertainPose, QuaternionCovarianceMatchesSampledRotations) {
  UncertainPose pose;
  pose.T = {quaternion_exp({0.4, -1.1, 0.7}), {1.0, 2.0, 3.0}};
  const Eigen::Vector3d sigma(0.01, 0.02, 0.005);
  pose.covariance.diagonal().tail<3>() = sigma.cwiseAbs2();
  std::mt19937 rng(3);
  std::normal_distribution<double> normal;
  Eigen::Matrix4d sampled = Eigen::Matrix4d::Zero();
  constexpr int kSamples = 40'000;
  for (int i = 0; i < kSamples; ++i) {
    const Eigen::Vector3d error(sigma.x() * normal(rng), sigma.y() * normal(rng), sigma.z() * normal(rng));
    const Eigen::Vector4d difference = wxyz(quaternion_exp(error) * pose.T.q) - wxyz(pose.T.q);
    sampled += difference * difference.transpose() / kSamples;
  }
  const auto covariance = position_quaternion_covariance(pose);
  const Eigen::Matrix4d expected = covariance.bottomRightCorner<4, 4>();
  EXPECT_LT((expected - sampled).norm(), 0.03 * expected.norm());
}

TEST(UncertainPose, RefusesWhatIsNotAPose) {
  UncertainPose pose;
  pose.covariance.setIdentity();
  EXPECT_TRUE(is_valid(pose));
  UncertainPose broken = pose;
  broken.T.p.x() = std::numeric_limits<double>::quiet_NaN();
  EXPECT_FALSE(is_valid(broken));
  broken = pose;
  broken.T.q.coeffs() *= 2.0;
  EXPECT_FALSE(is_valid(broken));
  broken = pose;
  broken.covariance(0, 0) = -1.0;
  EXPECT_FALSE(is_valid(broken));
}

}  // namespace
}  // namespace cosight
