#include "robot_agent/vins/rest.hpp"

#include <gtest/gtest.h>

#include <deque>

#include "shared/geometry/rotation.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

constexpr double kGravity = 9.81;
const Vector3d kForce(0.3, -0.2, 9.9);
const Vector3d kRate(0.01, -0.02, 0.005);

/// Frames 0.1 s apart whose features lie still up to `still` and then move by `speed` a frame; the IMU reads
/// the same throughout but for `force_later` from the middle on.
std::deque<UnplacedFrame> frames(int count, int still, double speed, const Vector3d& force_later = kForce,
                                 int features = 40) {
  std::deque<UnplacedFrame> result;
  for (int i = 0; i < count; ++i) {
    UnplacedFrame& frame = result.emplace_back();
    frame.features.stamp = from_seconds(0.1 * i);
    frame.features.features.resize(static_cast<std::size_t>(features));
    for (int k = 0; k < features; ++k) {
      TrackedFeature& feature = frame.features.features[static_cast<std::size_t>(k)];
      feature.id = static_cast<FeatureId>(k);
      feature.sighting.point = {0.01 * k + speed * std::max(0, i - still), 0.02 * (k % 7)};
    }
    if (i == 0) continue;
    const Vector3d force = 2 * i > count ? force_later : kForce;
    std::vector<ImuSample> samples;
    for (int s = 0; s <= 20; ++s)
      samples.push_back({from_seconds(0.1 * i - 0.1 + 0.005 * s), force, kRate});
    frame.imu.emplace(samples, ImuBias(), ImuNoise());
  }
  return result;
}

TEST(FindRest, GivesWhatTheImuReadUpToTheMiddle) {
  const auto rest = find_rest(frames(11, 11, 0.0, kForce + Vector3d(1.0, 0.0, 0.0)), {});
  ASSERT_TRUE(rest);
  EXPECT_EQ(rest->stamp, from_seconds(0.5));
  EXPECT_LT((rest->force_B - kForce).norm(), 1e-9);
  EXPECT_LT((rest->angular_velocity_B - kRate).norm(), 1e-9);
}

TEST(FindRest, IsNoneWhereMostFeaturesMove) {
  EXPECT_FALSE(find_rest(frames(11, 0, 1e-3), {}));
  EXPECT_TRUE(find_rest(frames(11, 9, 1e-3), {}));  // a pixel's third only: not to be seen yet
}

TEST(FindRest, IgnoresTheFewThatDrivePast) {
  auto still = frames(11, 11, 0.0);
  for (int k = 0; k < 15; ++k)
    still.back().features.features[static_cast<std::size_t>(k)].sighting.point.x() += 0.1;
  EXPECT_TRUE(find_rest(still, {}));
}

TEST(FindRest, NeedsFeaturesThatStay) {
  EXPECT_FALSE(find_rest(frames(11, 11, 0.0, kForce, 12), {}));
  auto others = frames(11, 11, 0.0);
  for (TrackedFeature& feature : others.back().features.features)
    feature.id += 1000;
  EXPECT_FALSE(find_rest(others, {}));
}

TEST(StateAtRest, StandsUprightAndHasTheBiasesThatMakeTheImuRead) {
  const Rest rest{.stamp = 0, .force_B = kForce, .angular_velocity_B = kRate};
  const NavState state = state_at(rest, kGravity);
  EXPECT_EQ(state.v_W, Vector3d::Zero());
  const Vector3d read = state.T_WB.q.conjugate() * Vector3d(0.0, 0.0, kGravity) + state.bias.accelerometer;
  EXPECT_LT((read - kForce).norm(), 1e-12);
  EXPECT_EQ(state.bias.gyroscope, kRate);
  const Vector3d heading = state.T_WB.q * Vector3d::UnitX();
  EXPECT_NEAR(heading.y(), 0.0, 1e-12);
  EXPECT_GT(heading.x(), 0.0);
}

TEST(RestPrior, IsAsStiffAgainstWhatChangesTheForceAsItsDeviationSays) {
  WindowFrame first;
  first.state = state_at({.stamp = 0, .force_B = kForce, .angular_velocity_B = kRate}, kGravity);
  const RestOptions options;
  const Prior prior = rest_prior(first, options, {}, kGravity);
  const auto force = [&](const Vector3d& theta, const Vector3d& bias) {
    const Eigen::Quaterniond q = first.state.T_WB.q * quaternion_exp(theta);
    return Vector3d(q.conjugate() * Vector3d(0.0, 0.0, kGravity) + bias);
  };
  constexpr double kStep = 1e-6;
  for (int axis = 0; axis < 3; ++axis) {
    const Vector3d step = kStep * Vector3d::Unit(axis);
    const Vector3d by_turn = (force(step, {0, 0, 0}) - force(-step, {0, 0, 0})) / (2.0 * kStep);
    EXPECT_LT((prior.J.bottomRows<3>().col(3 + axis) * options.force - by_turn).norm(), 1e-6);
    const Vector3d by_bias = Vector3d::Unit(axis);
    EXPECT_LT((prior.J.bottomRows<3>().col(9 + axis) * options.force - by_bias).norm(), 1e-12);
  }
  EXPECT_EQ(prior.J(6, 6), 1.0 / options.velocity);
  EXPECT_EQ(prior.residual, Eigen::VectorXd::Zero(18));
}

}  // namespace
}  // namespace cosight::vins
