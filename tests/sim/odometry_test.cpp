#include "sim/sensors/odometry.hpp"

#include <gtest/gtest.h>

#include <cmath>

#include "sim/motion/robot_motion.hpp"

namespace cosight::sim {
namespace {

RobotMotion around_a_corner() {
  return {PathPlan{{{0, 0}, {4, 0}, {4, 4}}, 1.0, 0.8, 1.5, 0.0}, Shaking{}, 4};
}

TEST(SimulateOdometry, AddsUpToTheWayWhenTheWheelsAreTrue) {
  const RobotMotion robot = around_a_corner();
  const OdometryPlan plan{
      .timing = {.rate = 50.0}, .scale_sigma = 0, .turn_scale_sigma = 0, .slip = 0, .turn_slip = 0};
  const auto rows = simulate_odometry(
      plan, [&](double t) { return robot.at(t); }, robot.path().duration(), 1);
  EXPECT_NEAR(rows.back().x, 4.0, 0.01);
  EXPECT_NEAR(rows.back().y, 4.0, 0.01);
  EXPECT_NEAR(rows[250].speed, 0.8, 0.01);
}

TEST(SimulateOdometry, DriftsOtherwiseInEachRun) {
  const RobotMotion robot = around_a_corner();
  const auto end = [&](std::uint64_t seed) {
    return simulate_odometry(
               {}, [&](double t) { return robot.at(t); }, robot.path().duration(), seed)
        .back();
  };
  const double drift = std::hypot(end(1).x - 4.0, end(1).y - 4.0);
  EXPECT_GT(drift, 0.002);
  EXPECT_LT(drift, 0.6);
  EXPECT_NE(end(1).x, end(2).x);
}

}  // namespace
}  // namespace cosight::sim
