#include "sim/sensors/laser.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

#include "sim/world/figures.hpp"
#include "sim/world/floor_plan.hpp"

namespace cosight::sim {
namespace {

/// A bare room, x and y from -3 to 5.
Scene bare_room() {
  FloorPlan plan;
  plan.outlines.push_back({{{-3, -3}, {5, -3}, {5, 5}, {-3, 5}}, Material::kBlank, 0.0});
  plan.texel = 0.1;
  return build_scene(plan, 1);
}

/// Distance from the origin to the walls of the bare room, by hand.
double range_by_hand(double angle) {
  const double x = std::cos(angle);
  const double y = std::sin(angle);
  return std::min((x > 0 ? 5.0 : 3.0) / std::abs(x), (y > 0 ? 5.0 : 3.0) / std::abs(y));
}

TEST(ExactRanges, AreThoseOfARoomInClosedForm) {
  const Scene room = bare_room();
  LaserPlan plan;
  plan.T_BL.p = {0, 0, 0.3};
  const std::vector<double> ranges = exact_ranges(plan, Pose{}, room.quads);
  ASSERT_EQ(ranges.size(), 133U);
  for (int k = 0; k < 133; ++k) {
    EXPECT_NEAR(ranges[static_cast<std::size_t>(k)], range_by_hand(plan.angle_of(k)), 1e-9) << k;
  }
}

TEST(ExactRanges, TurnWithTheRobotAndItsMounting) {
  const Scene room = bare_room();
  LaserPlan rear;
  rear.T_BL = {Eigen::Quaterniond(Eigen::AngleAxisd(3.0, Eigen::Vector3d::UnitZ())), {0.0, 0.0, 0.3}};
  const Pose T_WB{Eigen::Quaterniond(Eigen::AngleAxisd(0.5, Eigen::Vector3d::UnitZ())), {0, 0, 0}};
  const std::vector<double> ranges = exact_ranges(rear, T_WB, room.quads);
  EXPECT_NEAR(ranges[10], range_by_hand(rear.angle_of(10) + 3.5), 1e-9);
}

TEST(ExactRanges, MeetTheLegsOfAPerson) {
  Scene room = bare_room();
  std::vector<Quad> quads = room.quads;
  const PersonFigure person(room, 1, 0);
  Posture posture;
  posture.T_WP.p = {2.0, 0.1, 0.0};  // its right leg is straight ahead
  posture.T_WH.p = {2.0, 0.0, 1.65};
  person.add_to(quads, posture);
  LaserPlan plan;
  plan.T_BL.p = {0, 0, 0.3};
  const double ahead = exact_ranges(plan, Pose{}, quads)[66];
  EXPECT_NEAR(ahead, 2.0 - 0.08, 0.02);
}

TEST(SimulateLaser, ErrsAsMuchAsItSays) {
  const Scene room = bare_room();
  LaserPlan plan{.sigma = 0.03, .bias = 0.01, .miss = 0.1};
  plan.T_BL.p = {0, 0, 0.3};
  const auto scans = simulate_laser(
      plan, [](double) { return Pose{}; }, [&](double) { return room.quads; }, 4.0, 9);
  ASSERT_EQ(scans.size(), 101U);
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  double missed = 0.0;
  for (const LaserScan& scan : scans) {
    for (int k = 0; k < plan.points; ++k) {
      const float range = scan.ranges[static_cast<std::size_t>(k)];
      if (std::isinf(range)) {
        missed += 1.0;
        continue;
      }
      const double error = static_cast<double>(range) - range_by_hand(plan.angle_of(k));
      sum += error;
      squares += error * error;
      count += 1.0;
    }
  }
  EXPECT_NEAR(sum / count, 0.01, 0.002);
  EXPECT_NEAR(std::sqrt(squares / count - sum * sum / (count * count)), 0.03, 0.001);
  EXPECT_NEAR(missed / (count + missed), 0.1, 0.01);
}

TEST(SimulateLaser, SaysNothingOutsideItsRange) {
  const Scene room = bare_room();
  LaserPlan plan{.range_min = 3.5, .range_max = 4.5};
  plan.T_BL.p = {0, 0, 0.3};
  const auto scans = simulate_laser(
      plan, [](double) { return Pose{}; }, [&](double) { return room.quads; }, 0.0, 9);
  for (int k = 0; k < plan.points; ++k) {
    const double exact = range_by_hand(plan.angle_of(k));
    const bool inside = std::isfinite(scans[0].ranges[static_cast<std::size_t>(k)]);
    if (exact < 3.4 || exact > 4.6) {
      EXPECT_FALSE(inside) << k;
    }
  }
}

}  // namespace
}  // namespace cosight::sim
