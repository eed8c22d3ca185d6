// When the motion tells nothing, and when the data break off: what AdaptiveVins says, and that it starts
// (again).
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <random>
#include <vector>

#include "robot_agent/vins/adaptive_vins.hpp"
#include "robot_agent/vins/uncertainty.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

enum class Slow { kStanding, kTurning, kCoasting };

constexpr double kLivelyFrom = 4.0;  ///< [s]
constexpr double kGravity = 9.81;

/// A body that stands, only turns, or goes straight on at constant speed, and from kLivelyFrom on moves
/// freely. All rates are differences of the path, so that nothing is shared with the estimator.
class SlowStart {
 public:
  explicit SlowStart(Slow slow, unsigned seed = 7) : slow_(slow), random_(seed) {
    std::uniform_real_distribution<double> x(6.0, 16.0);
    std::uniform_real_distribution<double> y(-14.0, 22.0);
    std::uniform_real_distribution<double> z(-5.0, 6.0);
    for (int i = 0; i < 250; ++i)
      points_W_.emplace_back(x(random_), y(random_), z(random_));
  }

  Vector3d velocity(double t) const { return (position(t + kStep) - position(t - kStep)) / (2.0 * kStep); }

  ImuSample imu(double t) {
    const Vector3d a_W = (position(t + kStep) - 2.0 * position(t) + position(t - kStep)) / (kStep * kStep);
    const Eigen::Quaterniond q_WB = orientation(t);
    ImuSample sample{
        from_seconds(100.0 + t), q_WB.conjugate() * (a_W + Vector3d(0.0, 0.0, kGravity)),
        quaternion_log(orientation(t - kStep).conjugate() * orientation(t + kStep)) / (2.0 * kStep)};
    for (int axis = 0; axis < 3; ++axis) {
      sample.acceleration_B(axis) += 0.02 * normal_(random_);
      sample.angular_velocity_B(axis) += 0.002 * normal_(random_);
    }
    return sample;
  }

  FeatureFrame camera(double t) {
    const Pose T_SW = (Pose{orientation(t), position(t)} * T_BS()).inverse();
    FeatureFrame frame{from_seconds(100.0 + t), {}};
    for (std::size_t i = 0; i < points_W_.size(); ++i) {
      const Vector3d p_S = T_SW * points_W_[i];
      if (p_S.z() < 0.5 || std::abs(p_S.x()) > 0.8 * p_S.z() || std::abs(p_S.y()) > 0.6 * p_S.z()) continue;
      frame.features.push_back({i, {p_S.hnormalized()}});
      for (int axis = 0; axis < 2; ++axis)
        frame.features.back().sighting.point(axis) += 0.25 / 460.0 * normal_(random_);
    }
    return frame;
  }

  static Pose T_BS() { return SyntheticDrive(0).T_BS(); }

 private:
  static constexpr double kStep = 1e-3;  ///< [s]

  /// Zero until kLivelyFrom, one a second later, smooth to the second derivative.
  static double liveliness(double t) {
    const double x = std::clamp(t - kLivelyFrom, 0.0, 1.0);
    return x * x * x * (10.0 - 15.0 * x + 6.0 * x * x);
  }

  Vector3d position(double t) const {
    const Vector3d coast = slow_ == Slow::kCoasting ? Vector3d(0.0, 1.2 * t, 0.0) : Vector3d::Zero();
    const double s = t - kLivelyFrom;
    return coast + liveliness(t) *
                       Vector3d(1.2 * std::sin(1.1 * s), 1.5 * std::sin(1.3 * s), 0.5 * std::sin(1.7 * s));
  }

  Eigen::Quaterniond orientation(double t) const {
    const double turn = slow_ == Slow::kTurning ? 0.3 * std::sin(0.8 * t) : 0.0;
    const double s = t - kLivelyFrom;
    return Eigen::AngleAxisd(turn + 0.2 * liveliness(t) * std::sin(0.9 * s), Vector3d::UnitZ()) *
           Eigen::AngleAxisd(0.15 * liveliness(t) * std::sin(0.8 * s), Vector3d::UnitY());
  }

  Slow slow_;
  std::mt19937_64 random_;
  std::normal_distribution<double> normal_;
  std::vector<Vector3d> points_W_;
};

VinsOptions options() {
  VinsOptions options;
  options.initialisation.prior.accelerometer_bias = 0.02;
  options.window.solver.graph.trust.pixel_noise = 0.5;
  options.window.solver.graph.gravity = kGravity;
  return options;
}

/// Runs one world through the odometry, a frame each 0.1 s, IMU samples in time; what is in a gap is not
/// given.
class Trip {
 public:
  explicit Trip(Slow slow, unsigned seed = 7) : world(slow, seed), vins(options(), SlowStart::T_BS()) {}

  VinsEstimate step() {
    for (; imu_count_ * 0.005 <= t + 0.0051; ++imu_count_) {
      const double at = imu_count_ * 0.005;
      if (at < gap_from || at > gap_to) vins.add_imu(world.imu(at));
    }
    FeatureFrame frame = world.camera(t);
    if (spoil) spoil(frame);
    const VinsEstimate estimate = vins.process(frame);
    t += 0.1;
    return estimate;
  }

  VinsEstimate go_on_until(double end) {
    VinsEstimate estimate;
    while (t < end)
      estimate = step();
    return estimate;
  }

  /// Ratio of the estimated speed to the true one.
  double speed_ratio(const VinsEstimate& estimate) const {
    return estimate.report->state.v_W.norm() / world.velocity(t - 0.1).norm();
  }

  SlowStart world;
  AdaptiveVins vins;
  double t = 0.0;
  double gap_from = 1e9;
  double gap_to = 1e9;
  std::function<void(FeatureFrame&)> spoil;

 private:
  int imu_count_ = 0;
};

/// Outcomes while the motion is slow, counted; and whether it ever tracked then.
std::map<InitialisationOutcome, int> outcomes_while_slow(Trip& run) {
  std::map<InitialisationOutcome, int> outcomes;
  while (run.t < kLivelyFrom) {
    const VinsEstimate estimate = run.step();
    EXPECT_NE(estimate.status, VinsStatus::kTracking) << "at " << run.t << " s";
    if (run.t > 1.2) ++outcomes[estimate.initialisation];
  }
  return outcomes;
}

void expect_start_with_scale(Trip& run) {
  const VinsEstimate estimate = run.go_on_until(kLivelyFrom + 5.0);
  ASSERT_EQ(estimate.status, VinsStatus::kTracking) << to_string(estimate.initialisation);
  EXPECT_NEAR(run.speed_ratio(estimate), 1.0, 0.1);
}

class StartWithoutParallax : public testing::TestWithParam<Slow> {};
INSTANTIATE_TEST_SUITE_P(StandingAndTurning, StartWithoutParallax,
                         testing::Values(Slow::kStanding, Slow::kTurning));

TEST_P(StartWithoutParallax, WaitsForItAndBeginsWithTheMotion) {
  Trip run(GetParam());
  const auto outcomes = outcomes_while_slow(run);
  ASSERT_EQ(outcomes.size(), 1U);
  EXPECT_EQ(outcomes.begin()->first, InitialisationOutcome::kTooLittleParallax);
  expect_start_with_scale(run);
}

TEST(Start, SaysThatConstantVelocityTellsNoScaleAndBeginsWithTheMotion) {
  Trip run(Slow::kCoasting);
  const auto outcomes = outcomes_while_slow(run);
  for (const auto& [outcome, count] : outcomes) {
    EXPECT_TRUE(outcome == InitialisationOutcome::kScaleUnobservable ||
                outcome == InitialisationOutcome::kNoSolution)
        << to_string(outcome) << " " << count;
  }
  EXPECT_TRUE(outcomes.contains(InitialisationOutcome::kScaleUnobservable));
  expect_start_with_scale(run);
}

/// The rest tells gravity and biases, and that the speed was zero: the IMU leads on from there. Here it is a
/// perfect rest and a better IMU than is said, so that only too much trust can be seen.
TEST(Start, FromRestKnowsItsVelocityAtOnceAndIsNotTooSureOfIt) {
  constexpr unsigned kRuns = 20;
  double nees = 0.0;
  double worst = 0.0;
  for (unsigned seed = 1; seed <= kRuns; ++seed) {
    Trip run(Slow::kStanding, seed);
    VinsEstimate estimate;
    while (run.t < 8.0 && estimate.status != VinsStatus::kTracking)
      estimate = run.step();
    ASSERT_EQ(estimate.status, VinsStatus::kTracking) << seed;
    EXPECT_LT(run.t, kLivelyFrom + 1.5);
    const Window& window = run.vins.odometry().window();
    const auto P = state_covariance(window, options().window.solver.graph, window.frames.back().id);
    const Vector3d error = estimate.report->state.v_W - run.world.velocity(run.t - 0.1);
    nees += error.dot(P.block<3, 3>(6, 6).llt().solve(error)) / kRuns;
    worst = std::max(worst, error.norm());
  }
  EXPECT_LT(worst, 0.1);
  EXPECT_LT(nees, 4.98);  // 99.9 % of chi squared with 60 degrees of freedom, over 20
}

/// From a running start: spoils something, then good data again.
class Restart : public testing::Test {
 protected:
  void SetUp() override { ASSERT_EQ(run.go_on_until(9.0).status, VinsStatus::kTracking); }

  void expect_tracking_again(double until) {
    const VinsEstimate estimate = run.go_on_until(until);
    ASSERT_EQ(estimate.status, VinsStatus::kTracking) << to_string(estimate.initialisation);
    EXPECT_NEAR(run.speed_ratio(estimate), 1.0, 0.1);
  }

  Trip run{Slow::kStanding};
};

TEST_F(Restart, ComesAfterTheImuWasSilent) {
  run.gap_from = run.t + 0.2;
  run.gap_to = run.t + 0.7;
  std::map<Failure, int> failures;
  while (run.t < 10.5)
    ++failures[run.step().failure];
  EXPECT_EQ(failures[Failure::kImuGap], 1);
  expect_tracking_again(14.0);
}

TEST_F(Restart, IsNotNeededForAFewLostSamples) {
  run.gap_from = run.t + 0.2;
  run.gap_to = run.t + 0.23;
  for (; run.t < 10.5;)
    EXPECT_EQ(run.step().failure, Failure::kNone);
}

TEST_F(Restart, ComesAfterAllFeaturesVanishedForLong) {
  run.spoil = [](FeatureFrame& frame) { frame.features.clear(); };
  std::map<Failure, int> failures;
  for (const double end = run.t + 1.2; run.t < end;)
    ++failures[run.step().failure];
  EXPECT_EQ(failures[Failure::kLostTracks], 1);
  run.spoil = nullptr;
  expect_tracking_again(15.0);
}

TEST_F(Restart, IsNotNeededWhereTheImuBridgesHalfASecondWithoutFeatures) {
  run.spoil = [](FeatureFrame& frame) { frame.features.clear(); };
  for (const double end = run.t + 0.5; run.t < end;)
    EXPECT_EQ(run.step().failure, Failure::kNone);
  run.spoil = [](FeatureFrame& frame) {  // those that come back are others
    for (TrackedFeature& feature : frame.features)
      feature.id += 1000;
  };
  const VinsEstimate estimate = run.go_on_until(run.t + 3.0);
  EXPECT_EQ(estimate.status, VinsStatus::kTracking);
  EXPECT_EQ(estimate.restarts, 0);
  EXPECT_NEAR(run.speed_ratio(estimate), 1.0, 0.1);
}

TEST_F(Restart, OrNothingAtAllFollowsWhenEveryFeatureJumps) {
  run.spoil = [](FeatureFrame& frame) {  // each has become its neighbour
    for (std::size_t i = 0; i + 1 < frame.features.size(); ++i)
      frame.features[i].sighting = frame.features[i + 1].sighting;
  };
  run.go_on_until(run.t + 0.5);
  run.spoil = nullptr;
  expect_tracking_again(15.0);
}

}  // namespace
}  // namespace cosight::vins
