#include "sim/motion/wearer_motion.hpp"

#include <gtest/gtest.h>

#include <algorithm>

namespace cosight::sim {
namespace {

class WalkingAhead : public ::testing::Test {
 protected:
  Path path_{PathPlan{{{0, 0}, {20, 0}}, 1.0, 1.0, 1.0, 0.0}};
  WearerPlan plan_{.ahead = {{0.0, 2.0}}, .left = {{0.0, 0.5}}};
};

TEST_F(WalkingAhead, KeepsItsPlaceBesideTheRobot) {
  const WearerMotion wearer(plan_, path_, 1);
  const double time = 10.0;
  const Eigen::Vector3d feet = wearer.feet(time).p;
  EXPECT_NEAR(feet.x(), path_.walked(time) + 2.0, 1e-6);
  EXPECT_NEAR(feet.y(), 0.5, 1e-6);
}

TEST_F(WalkingAhead, BobsTwiceAGaitCycle) {
  const WearerMotion wearer(plan_, path_, 1);
  double low = 10.0;
  double high = 0.0;
  int tops = 0;
  for (double time = 5.0; time < 12.0; time += 0.01) {
    const double z = wearer.head(time).p.z();
    low = std::min(low, z);
    high = std::max(high, z);
    tops += z > wearer.head(time - 0.01).p.z() && z >= wearer.head(time + 0.01).p.z() ? 1 : 0;
  }
  EXPECT_NEAR(high - low, 2.0 * plan_.bob, 0.004);
  EXPECT_NEAR(tops, 7.0 * 1.0 / plan_.step_length, 1.1) << "one bob a step";
}

TEST_F(WalkingAhead, StandsStillBeforeTheStart) {
  const WearerMotion wearer(plan_, path_, 1);
  EXPECT_NEAR(wearer.liveliness(-5.0), 0.0, 1e-9);
  EXPECT_NEAR(wearer.head(-5.0).p.z(), plan_.head_height, 1e-9);
}

TEST_F(WalkingAhead, LooksWhereThePlanSays) {
  plan_.glance = 0.0;
  plan_.nod = 0.0;
  plan_.gaze_left = {{0.0, 0.7}};
  plan_.gaze_up = {{0.0, 0.2}};
  const Eigen::Vector3d gaze = WearerMotion(plan_, path_, 1).head(9.0).q * Eigen::Vector3d::UnitX();
  EXPECT_NEAR(std::atan2(gaze.y(), gaze.x()), 0.7, 1e-9);
  EXPECT_NEAR(std::asin(gaze.z()), 0.2, 1e-9);
}

}  // namespace
}  // namespace cosight::sim
