#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "experiments/urban_canyon/canyon.hpp"
#include "experiments/urban_canyon/parallel.hpp"
#include "experiments/urban_canyon/pose_consistency.hpp"

namespace cosight::experiments {
namespace {

using testing::Each;
using testing::IsEmpty;

CanyonOptions short_drive(CanyonOptions options) {
  options.length = 120.0;
  return options;
}

TEST(Workers, DoEachTaskOnce) {
  const std::atomic<bool> stop = false;
  std::vector<int> done(50, 0);
  Workers(3, stop).run("tasks", 50, [&](int i) { ++done[static_cast<std::size_t>(i)]; });
  EXPECT_THAT(done, Each(1));
}

TEST(Workers, HandOnWhatATaskThrows) {
  const std::atomic<bool> stop = false;
  EXPECT_THROW(Workers(2, stop).run("tasks", 9,
                                    [](int i) {
                                      if (i == 4) throw std::out_of_range("four");
                                    }),
               std::out_of_range);
}

TEST(Workers, EndEarlyWhenAskedTo) {
  std::atomic<bool> stop = false;
  std::atomic<int> done = 0;
  const auto task = [&](int) { stop = ++done >= 3; };
  EXPECT_THROW(Workers(1, stop).run("tasks", 1000, task), Interrupted);
  EXPECT_EQ(done, 3);
}

/// Velocity and acceleration are formulas of their own; here against differences of the position.
TEST(Route, HasTheDerivativesThatItsPositionHas) {
  std::mt19937_64 random(3);
  const Route route(500.0, random);
  constexpr double h = 1e-3;
  for (double t = 1.0; t < route.duration(); t += 0.73) {
    const Eigen::Vector3d velocity = (route.T_WB(t + h).p - route.T_WB(t - h).p) / (2.0 * h);
    const Eigen::Vector3d acceleration = (route.velocity_W(t + h) - route.velocity_W(t - h)) / (2.0 * h);
    EXPECT_LT((route.velocity_W(t) - velocity).norm(), 1e-3) << t;
    EXPECT_LT((route.acceleration_W(t) - acceleration).norm(), 1e-3) << t;
  }
}

TEST(Route, EndsWhereItsLengthIsDriven) {
  std::mt19937_64 random(4);
  const Route route(300.0, random);
  EXPECT_NEAR(route.distance(route.duration()), 300.0, 0.1);
}

TEST(Vehicle, HidesOnlyWhatStandsBehindIt) {
  Vehicle vehicle;
  vehicle.size = {4.5, 1.8, 1.5};
  const Eigen::Vector3d eye_V(-10.0, 0.0, 1.0);
  EXPECT_TRUE(vehicle.hides(eye_V, {20.0, 0.0, 1.0}));
  EXPECT_FALSE(vehicle.hides(eye_V, {20.0, 0.0, 8.0}));
  EXPECT_FALSE(vehicle.hides(eye_V, {-5.0, 0.0, 1.0}));
  EXPECT_FALSE(vehicle.hides(eye_V, {20.0, 20.0, 1.0}));
}

TEST(CanyonDrive, IsTheSameForTheSameSeed) {
  const CanyonDrive a = make_canyon_drive(short_drive(urban_canyon_1()), 5);
  const CanyonDrive b = make_canyon_drive(short_drive(urban_canyon_1()), 5);
  const CanyonDrive other = make_canyon_drive(short_drive(urban_canyon_1()), 6);
  ASSERT_EQ(a.sequence.frames.size(), b.sequence.frames.size());
  EXPECT_EQ(a.sequence.frames.back().features.front().sighting.point,
            b.sequence.frames.back().features.front().sighting.point);
  EXPECT_EQ(a.sequence.imu.back().acceleration_B, b.sequence.imu.back().acceleration_B);
  EXPECT_NE(a.sequence.imu.back().acceleration_B, other.sequence.imu.back().acceleration_B);
}

TEST(CanyonDrive, WithoutVehiclesKeepsEverythingElse) {
  const CanyonDrive drive = make_canyon_drive(short_drive(urban_canyon_2()), 5);
  ASSERT_GT(drive.moving_percent, 1.0);
  const vins::TrackSequence still = without_vehicles(drive);
  std::size_t before = 0;
  std::size_t after = 0;
  for (std::size_t i = 0; i < still.frames.size(); ++i) {
    before += drive.sequence.frames[i].features.size();
    after += still.frames[i].features.size();
  }
  EXPECT_NEAR(static_cast<double>(after), static_cast<double>(before) * (1.0 - drive.moving_percent / 100.0),
              1.0);
}

TEST(CanyonDrive, FollowsVehiclesLessWhereOutliersAreRejected) {
  CanyonOptions options = short_drive(urban_canyon_2());
  const double rejecting = make_canyon_drive(options, 5).moving_percent;
  options.front_end.ransac_threshold = 1e3;
  EXPECT_LT(rejecting, 0.9 * make_canyon_drive(options, 5).moving_percent);
}

TEST(CanyonDrive, HasNoFeatureOnAVehicleWhereThereIsNone) {
  EXPECT_THAT(make_canyon_drive(static_canyon(), 2).moving, IsEmpty());
}

/// A static feature seen in two frames lies on the epipolar line that the truth gives.
TEST(CanyonDrive, SeesStandingThingsFromWhereItsTruthSays) {
  CanyonOptions options = static_canyon();
  options.front_end.noise = 0.0;
  const CanyonDrive drive = make_canyon_drive(options, 7);
  const vins::TrackSequence& sequence = drive.sequence;
  const Pose T_WS_a = sequence.truth[20].T_WC * sequence.T_BS;
  const Pose T_WS_b = sequence.truth[25].T_WC * sequence.T_BS;
  const Pose T_ba = T_WS_b.inverse() * T_WS_a;
  int common = 0;
  for (const auto& a : sequence.frames[20].features) {
    for (const auto& b : sequence.frames[25].features) {
      if (a.id != b.id) continue;
      ++common;
      const Eigen::Vector3d line = T_ba.p.cross(T_ba.q * a.sighting.point.homogeneous());
      EXPECT_LT(std::abs(line.dot(b.sighting.point.homogeneous())) / line.head<2>().norm(), 1e-9);
    }
  }
  EXPECT_GT(common, 30);
}

}  // namespace
}  // namespace cosight::experiments
