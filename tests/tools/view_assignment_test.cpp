#include "tools/prepare/view_assignment.hpp"

#include <gtest/gtest.h>

#include <numbers>

#include "shared/geometry/rotation.hpp"

namespace cosight {
namespace {

Pose at(double x, double yaw = 0.0) {
  return {quaternion_exp({0, yaw, 0}), {x, 0, 0}};
}

TEST(ViewAssignment, OffersEachViewAtTheNearestFrame) {
  const auto offers = assign_views({at(2.1), at(0.2)}, {at(0), at(1), at(2)});
  ASSERT_EQ(offers.size(), 2U);
  EXPECT_EQ(offers[0].frame, 0U);
  EXPECT_EQ(offers[0].view, 1U);
  EXPECT_EQ(offers[1].frame, 2U);
  EXPECT_EQ(offers[1].view, 0U);
  EXPECT_NEAR(offers[0].baseline, 0.2, 1e-12);
}

TEST(ViewAssignment, GivesAFrameToTheNearerOfTwoViewsAndTheOtherTheNextOne) {
  const auto offers = assign_views({at(0.3), at(0.1)}, {at(0), at(1), at(2)});
  ASSERT_EQ(offers.size(), 2U);
  EXPECT_EQ(offers[0].view, 1U);
  EXPECT_EQ(offers[1].view, 0U);
  EXPECT_EQ(offers[1].frame, 1U);
}

TEST(ViewAssignment, PrefersAFrameThatLooksTheSameWay) {
  const auto offers = assign_views({at(0.0, 0.0)}, {at(0.0, std::numbers::pi / 2.0), at(1.5, 0.0)});
  ASSERT_EQ(offers.size(), 1U);
  EXPECT_EQ(offers[0].frame, 1U);
  EXPECT_NEAR(offers[0].axis_angle, 0.0, 1e-12);
}

TEST(ViewAssignment, LeavesOutViewsWhenThereAreMoreThanFrames) {
  EXPECT_EQ(assign_views({at(0), at(1), at(2)}, {at(0), at(1)}).size(), 2U);
}

}  // namespace
}  // namespace cosight
