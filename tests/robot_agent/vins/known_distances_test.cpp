#include "robot_agent/vins/known_distances.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <random>

#include "robot_agent/vins/uncertainty.hpp"
#include "robot_agent/vins/window_odometry.hpp"
#include "shared/geometry/rotation.hpp"
#include "tests/robot_agent/vins/synthetic_drive.hpp"

namespace cosight::vins {
namespace {

using Eigen::Vector3d;

constexpr double kDoubt = 0.03;  ///< of the known distances, in parts

FeatureFrame frame_with(const std::vector<double>& places) {
  FeatureFrame frame;
  frame.features.resize(places.size());
  for (std::size_t i = 0; i < places.size(); ++i)
    frame.features[i].sighting.point.x() = places[i];
  return frame;
}

TEST(GiveDistances, GoToTheNearestFeatureAndToOneOnly) {
  FeatureFrame frame = frame_with({0.0, 0.003, 0.1});
  EXPECT_EQ(give_distances({{{0.002, 0.0}, {0.5, 0.1}}}, 0.005, frame), 1);
  EXPECT_FALSE(frame.features[0].distance);
  ASSERT_TRUE(frame.features[1].distance);
  EXPECT_EQ(frame.features[1].distance->lambda, 0.5);
  EXPECT_FALSE(frame.features[2].distance);
}

TEST(GiveDistances, SecondOfTwoPlacesGetsTheNextFeature) {
  FeatureFrame frame = frame_with({0.0, 0.003});
  EXPECT_EQ(give_distances({{{0.0, 0.0}, {0.5, 0.1}}, {{0.001, 0.0}, {0.6, 0.1}}}, 0.005, frame), 2);
  EXPECT_EQ(frame.features[0].distance->lambda, 0.5);
  EXPECT_EQ(frame.features[1].distance->lambda, 0.6);
}

TEST(GiveDistances, AreDroppedWhereNoFeatureIsNear) {
  FeatureFrame frame = frame_with({0.0});
  EXPECT_EQ(give_distances({{{0.01, 0.0}, {0.5, 0.1}}}, 0.005, frame), 0);
  EXPECT_FALSE(frame.features[0].distance);
}

TEST(SeenFrom, IsTheDistanceFromTheOtherCameraWithItsDoubtToFirstOrder) {
  std::mt19937_64 random(3);
  std::normal_distribution<double> n;
  for (int i = 0; i < 20; ++i) {
    const Vector3d ray = Vector3d(0.3 * n(random), 0.3 * n(random), 1.0).normalized();
    const Pose T{quaternion_exp(0.3 * Vector3d(n(random), n(random), n(random))),
                 0.5 * Vector3d(n(random), n(random), n(random))};
    const auto inverse_distance = [&](double lambda) { return 1.0 / (T * Vector3d(ray / lambda)).norm(); };
    const KnownDistance seen = seen_from({.lambda = 0.25, .sigma = 0.01}, ray, T);
    EXPECT_NEAR(seen.lambda, inverse_distance(0.25), 1e-12);
    const double slope = (inverse_distance(0.25 + 1e-6) - inverse_distance(0.25 - 1e-6)) / 2e-6;
    EXPECT_NEAR(seen.sigma, 0.01 * std::abs(slope), 1e-8);
  }
}

TEST(Fused, AverageByTheirVariances) {
  const KnownDistance both = fused({.lambda = 0.2, .sigma = 0.01}, {.lambda = 0.26, .sigma = 0.02});
  EXPECT_NEAR(both.lambda, (4.0 * 0.2 + 0.26) / 5.0, 1e-12);
  EXPECT_NEAR(both.sigma, 0.01 * std::sqrt(0.8), 1e-12);
}

/// Each feature with its true distance, wrong by the doubt or by nothing, and told `factor` times too far.
FeatureFrame camera(SyntheticDrive& drive, double t, std::mt19937_64* random, double factor = 1.0) {
  std::normal_distribution<double> n(0.0, kDoubt);
  FeatureFrame frame = drive.camera(t, 0.25);
  for (TrackedFeature& feature : frame.features) {
    const double lambda = 1.0 / drive.distance(feature.id, t) / factor;
    const double error = random != nullptr ? n(*random) : 0.0;
    feature.distance = KnownDistance{.lambda = lambda * (1.0 + error), .sigma = kDoubt * lambda};
  }
  return frame;
}

WindowOptions fixed_mode() {
  WindowOptions options;
  options.solver.graph.trust.mode = TrustMode::kFixed;
  options.solver.graph.trust.fixed_kernel = Kernel::kNone;
  options.solver.graph.trust.pixel_noise = 0.25;
  return options;
}

void add_frame(Window& window, FrameId id, const NavState& state) {
  WindowFrame& frame = window.frames.emplace_back();
  frame.id = id;
  frame.state = state;
}

TEST(LearnDistances, BringsThemToWhereALandmarkWasSeenFirst) {
  SyntheticDrive drive(4);
  Window window;
  window.T_BS = drive.T_BS();
  add_frame(window, 0, drive.state(0.0));
  window.add_observations(drive.camera(0.0, 0.0));
  add_frame(window, 1, drive.state(0.5));
  FeatureFrame newest = drive.camera(0.5, 0.0);
  for (TrackedFeature& feature : newest.features)
    feature.distance = KnownDistance{.lambda = 1.0 / drive.distance(feature.id, 0.5), .sigma = 0.01};
  window.add_observations(newest);
  learn_distances(window, newest);
  int moved = 0;
  for (const TrackedFeature& feature : newest.features) {
    const Landmark& landmark = window.landmarks.at(feature.id);
    ASSERT_TRUE(landmark.known);
    const double t = landmark.observations.front().frame == 0 ? 0.0 : 0.5;
    EXPECT_NEAR(1.0 / landmark.known->lambda, drive.distance(feature.id, t), 1e-6);
    moved += t == 0.0 ? 1 : 0;
  }
  EXPECT_GT(moved, 20);
}

/// A start whose speed nobody knows, into a drive at almost constant velocity: only the distances tell it.
double speed_error_after(double seconds, bool with_distances) {
  SyntheticDrive drive(6);
  WindowOdometry odometry(fixed_mode(), drive.noise, drive.T_BS());
  NavState start = drive.state(0.0);
  start.v_W *= 1.5;
  std::mt19937_64 random(1);
  const auto look = [&](double t) {
    return with_distances ? camera(drive, t, &random) : drive.camera(t, 0.25);
  };
  odometry.start(look(0.0), start, {.tilt = 0.05, .velocity = 2.0, .accelerometer_bias = 0.3});
  WindowReport report;
  for (int i = 1; i <= std::lround(10.0 * seconds); ++i)
    report = odometry.process(look(0.1 * i), drive.imu(0.1 * i - 0.1, 0.1 * i));
  return (report.state.v_W - drive.state(seconds).v_W).norm();
}

TEST(KnownDistances, TellTheScaleBeforeTheAccelerationsDo) {
  EXPECT_LT(speed_error_after(0.6, true), 0.1);
  EXPECT_LT(speed_error_after(0.6, true), 0.3 * speed_error_after(0.6, false));
}

/// The drive's biases and a guess of its first state, both as `doubt` says.
NavState drawn_start(SyntheticDrive& drive, const StartUncertainty& doubt, std::mt19937_64& random) {
  std::normal_distribution<double> n;
  const auto draw = [&](double sigma) { return Vector3d(sigma * Vector3d(n(random), n(random), n(random))); };
  NavState guess = drive.state(0.0);
  drive.bias = {draw(doubt.accelerometer_bias), draw(doubt.gyroscope_bias)};
  guess.T_WB.p += draw(doubt.position);
  const Vector3d turn_W = draw(1.0).cwiseProduct(Vector3d(doubt.tilt, doubt.tilt, doubt.yaw));
  guess.T_WB.q = quaternion_exp(turn_W) * guess.T_WB.q;
  guess.v_W += draw(doubt.velocity);
  return guess;
}

TEST(KnownDistances, LeaveTheWindowAsSureAsItIsRight) {
  constexpr int kRuns = 30;
  double nees = 0.0;
  for (unsigned seed = 0; seed < kRuns; ++seed) {
    SyntheticDrive drive(seed);
    std::mt19937_64 random(seed);
    const StartUncertainty doubt{.velocity = 0.3, .accelerometer_bias = 0.02, .gyroscope_bias = 1e-3};
    const NavState start = drawn_start(drive, doubt, random);
    const WindowOptions options = fixed_mode();
    WindowOdometry odometry(options, drive.noise, drive.T_BS());
    odometry.start(camera(drive, 0.0, &random), start, doubt);
    for (int i = 1; i <= 25; ++i)
      odometry.process(camera(drive, 0.1 * i, &random), drive.imu(0.1 * i - 0.1, 0.1 * i));
    const WindowFrame& newest = odometry.window().frames.back();
    const auto P = state_covariance(odometry.window(), options.solver.graph, newest.id);
    const Vector3d error = newest.state.T_WB.p - drive.state(2.5).T_WB.p;
    nees += error.dot(P.topLeftCorner<3, 3>().llt().solve(error)) / kRuns;
  }
  // 99.9 % of chi squared with 90 degrees of freedom, over 30.
  EXPECT_GT(nees, 1.71);
  EXPECT_LT(nees, 4.69);
}

TEST(CheckDistances, FindsAScaleThatTheyContradictAndNoneWhereTheyAgree) {
  for (const double factor : {1.0, 1.3, 3.0}) {
    SyntheticDrive drive(7);
    WindowOdometry odometry(fixed_mode(), drive.noise, drive.T_BS());
    odometry.start(camera(drive, 0.0, nullptr, factor), drive.state(0.0), {});
    WindowReport report;
    for (int i = 1; i <= 8; ++i)
      report = odometry.process(camera(drive, 0.1 * i, nullptr, factor), drive.imu(0.1 * i - 0.1, 0.1 * i));
    EXPECT_GT(report.distances.count, 30);
    EXPECT_EQ(contradicts(report.distances), factor > 2.0) << factor << ": " << report.distances.ratio;
  }
}

TEST(CheckDistances, NeedsSeveral) {
  EXPECT_FALSE(contradicts({.count = 4, .ratio = 10.0}));
  EXPECT_TRUE(contradicts({.count = 5, .ratio = 10.0}));
  EXPECT_TRUE(contradicts({.count = 5, .ratio = 0.1}));
  EXPECT_FALSE(contradicts({}));
}

}  // namespace
}  // namespace cosight::vins
