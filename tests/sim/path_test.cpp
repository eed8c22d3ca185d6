#include "sim/motion/path.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <numbers>
#include <stdexcept>

namespace cosight::sim {
namespace {

PathPlan around_a_corner() {
  return {{{0, 0}, {6, 0}, {6, 5}}, 1.0, 0.8, 2.0, 1.0};
}

TEST(Path, StartsAndEndsAtItsWaypoints) {
  const Path path(around_a_corner());
  EXPECT_NEAR((path.at(0.0) - Eigen::Vector2d(0, 0)).norm(), 0.0, 1e-9);
  EXPECT_NEAR((path.at(path.length()) - Eigen::Vector2d(6, 5)).norm(), 0.0, 1e-9);
  // Two straights of 5 and 4 m and a quarter circle of 1 m.
  EXPECT_NEAR(path.length(), 9.0 + 0.5 * std::numbers::pi, 0.02);
}

TEST(Path, RoundsItsCornerOnACircle) {
  const Path path(around_a_corner());
  const Eigen::Vector2d middle = path.at(5.0 + 0.25 * std::numbers::pi);
  EXPECT_NEAR((middle - Eigen::Vector2d(5.0, 1.0)).norm(), 1.0, 0.01);
  EXPECT_NEAR(path.heading(5.0 + 0.25 * std::numbers::pi), 0.25 * std::numbers::pi, 0.03);
  EXPECT_NEAR(path.heading(path.length()), 0.5 * std::numbers::pi, 0.03);
}

TEST(Path, WalksAtItsSpeedAndStopsAtTheEnd) {
  const Path path(around_a_corner());
  EXPECT_EQ(path.walked(0.9), 0.0);
  EXPECT_NEAR(path.walked(6.5) - path.walked(5.5), 0.8, 1e-9);
  EXPECT_NEAR(path.speed(6.0), 0.8, 1e-9);
  EXPECT_NEAR(path.walked(path.duration()), path.length(), 1e-9);
  EXPECT_EQ(path.walked(path.duration() + 5.0), path.length());
}

TEST(Path, HasNoStepInItsAcceleration) {
  const Path path(around_a_corner());
  const double h = 1e-3;
  const auto acceleration = [&](double time) -> Eigen::Vector2d {
    return (path.at(path.walked(time + h)) - 2.0 * path.at(path.walked(time)) +
            path.at(path.walked(time - h))) /
           (h * h);
  };
  for (double time = 0.5; time < path.duration() + 0.5; time += 0.01) {
    EXPECT_LT((acceleration(time + 0.01) - acceleration(time)).norm(), 0.12) << time;
  }
}

TEST(Path, CountsTurnsInItsHeading) {
  const Path path({{{0, 0}, {4, 0}, {4, 4}, {0, 4}, {0, 1}, {3, 1}}, 0.8, 1.0, 1.0, 0.0});
  EXPECT_NEAR(path.heading(path.length()), 2.0 * std::numbers::pi, 0.05);
}

TEST(Path, GoesStraightOnOutside) {
  const Path path(around_a_corner());
  EXPECT_NEAR((path.at(-2.0) - Eigen::Vector2d(-2, 0)).norm(), 0.0, 0.05);
  EXPECT_NEAR((path.at(path.length() + 2.0) - Eigen::Vector2d(6, 7)).norm(), 0.0, 0.05);
}

TEST(Path, RefusesWhatIsNoWay) {
  EXPECT_THROW(Path({{{0, 0}}, 1.0, 1.0, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(Path({{{0, 0}, {3, 0}, {1, 0}}, 1.0, 1.0, 1.0, 0.0}), std::invalid_argument);
  EXPECT_THROW(Path({{{0, 0}, {3, 0}}, 1.0, 0.0, 1.0, 0.0}), std::invalid_argument);
}

}  // namespace
}  // namespace cosight::sim
