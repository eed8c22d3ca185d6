#include <gtest/gtest.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <cmath>
#include <filesystem>
#include <fstream>
#include <sstream>

#include "shared/dataset/cosight_dataset.hpp"
#include "sim/city/streets.hpp"
#include "sim/simulation.hpp"

namespace cosight::sim {
namespace {

namespace fs = std::filesystem;
using Eigen::Vector2d;
using Eigen::Vector3d;

/// A short way through coarse houses, small pictures, dense traffic. The car stands for its first two
/// seconds.
CityScenario short_drive() {
  CityScenario scenario;
  scenario.length = 25.0;
  scenario.city.front_texel = 0.2;
  scenario.traffic.ahead_share = 1.0;
  scenario.traffic.oncoming_per_minute = 40.0;
  scenario.traffic.texture = 0.0;
  scenario.camera.lens = {.fx = 120, .fy = 120, .cx = 99.5, .cy = 63.5, .width = 200, .height = 128};
  scenario.camera.T_BC = optical_mount({0.4, 0.1, 0.6}, 0.0, 0.02);
  return scenario;
}

double distance_to(const HouseLine& line, const Vector2d& p) {
  const Vector2d along = line.to - line.from;
  const double share = std::clamp(along.dot(p - line.from) / along.squaredNorm(), 0.0, 1.0);
  return (p - line.from - share * along).norm();
}

std::string bytes_below(const fs::path& folder) {
  std::vector<fs::path> files;
  for (const auto& entry : fs::recursive_directory_iterator(folder))
    if (entry.is_regular_file()) files.push_back(entry.path());
  std::sort(files.begin(), files.end());
  std::ostringstream bytes;
  for (const fs::path& file : files)
    bytes << fs::relative(file, folder).string() << std::ifstream(file, std::ios::binary).rdbuf();
  return bytes.str();
}

class CityDataset : public ::testing::Test {
 protected:
  void TearDown() override { fs::remove_all(root_); }

  std::string written(const std::string& name, std::uint64_t seed, unsigned threads) {
    CityScenario scenario = short_drive();
    scenario.camera.timing.rate = 1.0;
    write_dataset(CityRun(scenario, seed), {.seed = seed, .threads = threads}, root_ / name, stop_);
    return bytes_below(root_ / name);
  }

  std::atomic<bool> stop_{false};
  fs::path root_ = fs::path(::testing::TempDir()) / ("city_" + std::to_string(::getpid()));
};

TEST(CityRun, WhileTheCarStandsOnlyVehiclesChangeThePicture) {
  const CityScenario scenario = short_drive();
  const CityRun run(scenario, 5);
  constexpr double kThen = 0.2, kNow = 1.8;  // [s]
  ASSERT_NEAR(run.route().distance(kNow), 0.0, 1e-9);
  Renderer then_renderer(run.camera().camera), now_renderer(run.camera().camera);
  const Pose T_WC = run.camera().T_WC(kThen);
  const std::vector<Quad> quads_then = run.quads_at(kThen), quads_now = run.quads_at(kNow);
  const Radiance& then = then_renderer.render(quads_then, T_WC);
  const Radiance& now = now_renderer.render(quads_now, T_WC);
  // What stands still comes first, in both alike.
  const auto differs = std::mismatch(quads_then.begin(), quads_then.end(), quads_now.begin(), quads_now.end(),
                                     [](const Quad& a, const Quad& b) { return a.origin == b.origin; });
  const auto standing = static_cast<std::uint16_t>(differs.first - quads_then.begin());
  int moved = 0;
  int wrong = 0;
  const auto is_still = [&](std::size_t k) { return then.quad[k] < standing && now.quad[k] < standing; };
  for (std::size_t k = 0; k < then.brightness.size(); ++k) {
    if (!is_still(k)) ++moved;
    if (is_still(k) && then.depth[k] != now.depth[k]) ++wrong;
  }
  EXPECT_GT(moved, 50);
  EXPECT_EQ(wrong, 0);
}

TEST(CityRun, ImuFeelsTheDerivativesOfTheRoute) {
  CityScenario scenario = short_drive();
  scenario.imu.gyro_density = scenario.imu.gyro_bias = scenario.imu.gyro_bias_wander = 0.0;
  scenario.imu.acceleration_density = scenario.imu.acceleration_bias = 0.0;
  scenario.imu.acceleration_bias_wander = 0.0;
  const CityRun run(scenario, 2);
  double largest = 0.0;
  for (const BiasedImuSample& sample : run.imu()) {
    const double t = to_seconds(sample.measured.stamp - kStartStamp);
    const Vector3d force_W = run.route().acceleration_W(t) + Vector3d(0.0, 0.0, 9.80665);
    const Vector3d force_B = run.route().T_WB(t).q.conjugate() * force_W;
    EXPECT_LT((sample.measured.acceleration_I - force_B).norm(), 2e-3) << t;
    EXPECT_LT((sample.measured.angular_velocity_I - run.route().body_rate(t)).norm(), 1e-4) << t;
    largest = std::max(largest, run.route().acceleration_W(t).norm());
  }
  EXPECT_GT(largest, 1.0);
}

TEST_F(CityDataset, SameSeedGivesTheSameBytesWithAnyNumberOfThreads) {
  const std::string once = written("once", 3, 1);
  EXPECT_EQ(written("again", 3, 2), once);
  EXPECT_NE(written("other", 4, 2), once);
}

TEST_F(CityDataset, IsADatasetThatTheRobotReads) {
  written("drive", 3, 2);
  const CosightDataset dataset(root_ / "drive");
  EXPECT_FALSE(dataset.has_wearer());
  EXPECT_TRUE(dataset.has_imu());
  EXPECT_NEAR(dataset.T_BS()->p.z(), 0.6, 1e-9);
}

TEST(Streets, LeaveTheWholeWayFreeOfHouses) {
  for (std::uint64_t seed = 1; seed <= 5; ++seed) {
    std::mt19937_64 random(seed);
    const Route route(900.0, random);
    const std::vector<Vehicle> traffic = make_traffic(route, {.turning_per_minute = 4.0}, random);
    const std::vector<HouseLine> lines = house_lines(streets_of(route, traffic));
    for (double s = 0.0; s < route.length(); s += 3.0) {
      for (const HouseLine& line : lines)
        EXPECT_GT(distance_to(line, route.centre(s)), 6.0) << "seed " << seed << ", s " << s;
    }
  }
}

TEST(Streets, HaveOneForVehiclesThatTurn) {
  std::mt19937_64 random(1);
  const Route route(900.0, random);
  const std::vector<Vehicle> traffic = make_traffic(route, {.turning_per_minute = 6.0}, random);
  const std::vector<Street> streets = streets_of(route, traffic);
  EXPECT_TRUE(std::any_of(streets.begin(), streets.end(), [](const Street& street) { return !street.main; }));
}

/// Whoever drives ahead comes from behind the car and leaves far ahead.
TEST(Traffic, NobodyAppearsBeforeTheCarWhenItIsContinuous) {
  std::mt19937_64 random(7);
  const Route route(600.0, random, {.start_speed = 0.0, .hills = 0.0});
  TrafficOptions only_ahead{.ahead_share = 1.0, .continuous = true};
  only_ahead.neighbours_per_minute = only_ahead.oncoming_per_minute = only_ahead.turning_per_minute = 0.0;
  only_ahead.crossing_per_corner = 0.0;
  const std::vector<Vehicle> traffic = make_traffic(route, only_ahead, random);
  ASSERT_GT(traffic.size(), 2U);
  for (const Vehicle& vehicle : traffic) {
    EXPECT_LT((route.T_WB(vehicle.from).inverse() * vehicle.T_WV(vehicle.from).p).x(), -5.0);
    EXPECT_GT((vehicle.T_WV(vehicle.to).p - route.T_WB(vehicle.to).p).norm(), 60.0);
  }
}

}  // namespace
}  // namespace cosight::sim
