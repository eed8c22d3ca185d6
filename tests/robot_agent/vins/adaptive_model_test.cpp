#include "robot_agent/vins/adaptive_model.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "robot_agent/vins/misfit.hpp"

namespace cosight::vins {
namespace {

TEST(GeometryFactor, IsThatOfThreeAxes) {
  const std::vector<Eigen::Vector3d> axes{{1, 0, 0}, {0, 1, 0}, {0, 0, 1}};
  EXPECT_NEAR(geometry_factor(axes), std::sqrt(3.0), 1e-12);
}

TEST(GeometryFactor, FallsWithMoreFeaturesAndWithWiderOnes) {
  const auto ring = [](int count, double width) {
    std::vector<Eigen::Vector3d> directions;
    for (int i = 0; i < count; ++i) {
      const double a = 2.0 * std::numbers::pi * i / count;
      directions.emplace_back(Eigen::Vector3d(width * std::cos(a), width * std::sin(a), 1.0).normalized());
    }
    return directions;
  };
  EXPECT_NEAR(geometry_factor(ring(40, 0.5)), geometry_factor(ring(10, 0.5)) / 2.0, 1e-9);
  EXPECT_LT(geometry_factor(ring(10, 0.8)), geometry_factor(ring(10, 0.4)));
}

TEST(GeometryFactor, IsUnknownWhenAllFeaturesAreInOnePlane) {
  EXPECT_EQ(geometry_factor({{1, 0, 0}, {0, 1, 0}}), 0.0);
  EXPECT_EQ(geometry_factor({{1, 0, 0}, {0, 1, 0}, {0.6, 0.8, 0}}), 0.0);
}

TEST(Trust, OfTheFixedModeDoesNotLookAtTheFeature) {
  TrustOptions options{.mode = TrustMode::kFixed};
  EXPECT_EQ(trust(options, {1, 0.5, 0.0}).sqrt_information, trust(options, {50, 2.0, 0.0}).sqrt_information);
  EXPECT_NEAR(trust(options, {1, 0.5, 0.0}).sqrt_information, options.focal_length / options.pixel_noise,
              1e-9);
}

TEST(Trust, FollowsV26InEachReading) {
  TrustOptions options{.mode = TrustMode::kTracking, .pixel_noise = 1.5};
  const double fixed = 460.0 / 1.5;
  const double w = 20 * 0.02 / 0.8;
  options.information = InformationReading::kScalesRoot;
  EXPECT_NEAR(trust(options, {20, 0.8, 0.0}).sqrt_information, fixed * w, 1e-9);
  options.information = InformationReading::kScalesInformation;
  EXPECT_NEAR(trust(options, {20, 0.8, 0.0}).sqrt_information, fixed * std::sqrt(w), 1e-9);
  options.information = InformationReading::kAsPrinted;
  EXPECT_NEAR(trust(options, {20, 0.8, 0.0}).sqrt_information, std::sqrt(fixed * w), 1e-9);
}

TEST(Trust, WithoutAGeometryFactorIsTheFixedOne) {
  const TrustOptions options{.mode = TrustMode::kRobust};
  EXPECT_EQ(trust(options, {9, 0.0, 0.0}).kernel, options.fixed_kernel);
}

TEST(Trust, HuberThresholdGrowsWithN) {
  TrustOptions options{.mode = TrustMode::kRobust};
  EXPECT_EQ(trust(options, {25, 1.0, 0.0}).kernel, Kernel::kHuber);
  EXPECT_NEAR(trust(options, {25, 1.0, 0.0}).threshold, 0.5, 1e-12);
  options.threshold = ThresholdReading::kRoot;
  EXPECT_NEAR(trust(options, {25, 1.0, 0.0}).threshold, 0.1, 1e-12);
}

TEST(GuardedWeight, NeverTrustsMoreThanTheFixedMode) {
  const TrustOptions options{.mode = TrustMode::kGuarded};
  for (const int N : {1, 4, 20, 200}) {
    for (const double misfit : {0.0, 1.0, 20.0}) {
      EXPECT_LE(guarded_weight(options, {N, 0.1, misfit}), 1.0);
      EXPECT_GT(guarded_weight(options, {N, 0.1, misfit}), 0.0);
    }
  }
}

TEST(GuardedWeight, FallsWithTheFourthPowerOfWhatIsTooMuchMisfit) {
  const TrustOptions options{.mode = TrustMode::kGuarded};
  EXPECT_EQ(guarded_weight(options, {4, 0.5, options.misfit_width}), 1.0);
  EXPECT_NEAR(guarded_weight(options, {200, 0.5, 2.0 * options.misfit_width}), 1.0 / 16.0, 1e-12);
}

/// A window in which `bent` of 20 landmarks lie ten times as far off as the others.
Window window_with(int bent) {
  Window window;
  window.typical_misfit = bent > 10 ? 1e-2 : 1e-3;
  window.usual_misfit = 1e-3;
  for (FeatureId id = 0; id < 20; ++id)
    window.landmarks[id].misfit = id < static_cast<FeatureId>(bent) ? 1e-2 : 1e-3;
  return window;
}

TEST(WatchForMovers, ActsWhenManyBendAndRestsOnlyWhenFewDo) {
  const TrustOptions options;
  Window window = window_with(5);
  watch_for_movers(window, options);
  EXPECT_FALSE(window.many_bend) << "a quarter, from rest";
  window = window_with(8);
  watch_for_movers(window, options);
  EXPECT_TRUE(window.many_bend);
  window.landmarks = window_with(5).landmarks;
  watch_for_movers(window, options);
  EXPECT_TRUE(window.many_bend) << "a quarter, once it acts";
  window.landmarks = window_with(3).landmarks;
  watch_for_movers(window, options);
  EXPECT_FALSE(window.many_bend);
}

/// Before a red light, most of what is seen may be on vehicles.
TEST(WatchForMovers, ActsWhereMostBend) {
  Window window = window_with(17);
  watch_for_movers(window, TrustOptions());
  EXPECT_TRUE(window.many_bend);
}

/// A landmark that a camera which goes along x sees `off` radians beside where it is, up and down in turn.
Window window_seen_badly(double off, double seconds_per_frame) {
  Window window;
  for (FrameId i = 0; i < 8; ++i) {
    WindowFrame frame;
    frame.id = i;
    frame.stamp = from_seconds(seconds_per_frame * static_cast<double>(i));
    frame.state.T_WB.p.x() = 0.2 * static_cast<double>(i);
    window.frames.push_back(frame);
  }
  Landmark landmark;
  landmark.lambda = 0.2;
  landmark.has_depth = true;
  for (const WindowFrame& frame : window.frames) {
    const double up = frame.id == 0 ? 0.0 : (frame.id % 2 == 0 ? off : -off);
    Observation seen;
    seen.frame = frame.id;
    seen.sighting.point = {-frame.state.T_WB.p.x() / 5.0, up};
    landmark.observations.push_back(seen);
  }
  window.landmarks.emplace(1, landmark);
  return window;
}

TEST(MeasureMisfits, TellsHowFarSightingsAreFromAPoint) {
  Window window = window_seen_badly(1e-3, 0.1);
  measure_misfits(window, 4);
  EXPECT_NEAR(window.landmarks.at(1).misfit, 1e-3, 2e-5);
  EXPECT_NEAR(window.typical_misfit, 1e-3, 2e-5);
}

TEST(MeasureMisfits, LearnsWhatIsUsualWithinSeconds) {
  constexpr double dt = 0.1;
  Window window = window_seen_badly(1e-3, dt);
  measure_misfits(window, 4);
  window.landmarks = window_seen_badly(5e-3, dt).landmarks;
  for (double t = 0.0; t < 10.0; t += dt)
    measure_misfits(window, 4, false);
  EXPECT_NEAR(window.usual_misfit, window.typical_misfit, 0.05 * window.typical_misfit);
}

TEST(MeasureMisfits, FollowsWhatIsUsualSlowly) {
  constexpr double dt = 0.1;
  Window window = window_seen_badly(1e-3, dt);
  measure_misfits(window, 4);
  const double quiet = window.usual_misfit;
  window.landmarks = window_seen_badly(5e-3, dt).landmarks;
  for (double t = 0.0; t < 10.0; t += dt)
    measure_misfits(window, 4);
  EXPECT_LT(window.usual_misfit, 1.5 * quiet) << "ten seconds between vehicles";
  EXPECT_EQ(window.reference_misfit(), window.usual_misfit);
  for (double t = 0.0; t < 120.0; t += dt)
    measure_misfits(window, 4);
  EXPECT_NEAR(window.usual_misfit, window.typical_misfit, 0.05 * window.typical_misfit) << "another camera";
}

}  // namespace
}  // namespace cosight::vins
