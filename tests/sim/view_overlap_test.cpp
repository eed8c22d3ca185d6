#include "sim/render/view_overlap.hpp"

#include <gtest/gtest.h>

#include "test_quads.hpp"

namespace cosight::sim {
namespace {

class SeenByBoth : public ::testing::Test {
 protected:
  Texture texture_{gradient(100, 0)};
  Camera camera_{CameraModel{.fx = 120, .fy = 120, .cx = 79.5, .cy = 59.5, .width = 160, .height = 120}};
  std::vector<Quad> quads_{wall_ahead(4.0, 40.0, texture_)};
};

TEST_F(SeenByBoth, IsAllFromTheSamePlace) {
  EXPECT_EQ(seen_by_both(quads_, camera_, looking_ahead(), camera_, looking_ahead()), 1.0);
}

TEST_F(SeenByBoth, IsHalfWhenTheOtherStandsHalfAPictureAside) {
  const Pose T_WB = optical_mount({0.0, -0.5 * 160.0 / 120.0 * 4.0, 0.0}, 0.0, 0.0);
  EXPECT_NEAR(seen_by_both(quads_, camera_, looking_ahead(), camera_, T_WB), 0.5, 0.04);
}

TEST_F(SeenByBoth, IsNothingWhenTheOtherLooksAway) {
  EXPECT_EQ(seen_by_both(quads_, camera_, looking_ahead(), camera_, optical_mount({0, 0, 0}, 3.0, 0.0)), 0.0);
}

TEST_F(SeenByBoth, IsNothingBehindAWall) {
  quads_.push_back(wall_ahead(2.0, 30.0, texture_));
  const Pose T_WB = optical_mount({3.0, 0.0, 0.0}, 0.0, 0.0);
  EXPECT_EQ(seen_by_both(quads_, camera_, T_WB, camera_, looking_ahead()), 0.0);
}

}  // namespace
}  // namespace cosight::sim
