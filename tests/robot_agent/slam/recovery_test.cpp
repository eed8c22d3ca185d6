// A filter that sees nothing, or too little to check it.
#include <gtest/gtest.h>

#include <algorithm>
#include <memory>

#include "tests/robot_agent/slam/world_runs.hpp"

namespace cosight::slam {
namespace {

/// The robot's lens is covered, and nothing comes from the wearer.
FrameBundle in_the_dark(int frame) {
  FrameBundle bundle = world().without_wearer(frame);
  auto black = std::make_shared<GrayImage>(*bundle.image);
  std::fill(black->data.begin(), black->data.end(), std::uint8_t{0});
  bundle.image = black;
  return bundle;
}

TEST(Recovery, LostItSaysSoWithinASecondAndBeginsAnewWhereTheMotionLed) {
  CollaborativeSlam slam = collaborative();
  const auto before = run(slam, 0, 12);
  const std::size_t mapped = slam.map().size();
  std::vector<FrameEstimate> dark;
  for (int frame = 12; frame < 30; ++frame)
    dark.push_back(slam.process(in_the_dark(frame)));
  EXPECT_EQ(dark[9].tracking, Tracking::kLost) << "a second after the light went out";
  EXPECT_EQ(dark.back().resets, 1);
  EXPECT_GE(slam.map().size(), mapped) << "what was mapped stays in the map";
  const auto after = run(slam, 30, 40);
  for (const FrameEstimate& estimate : after) {
    expect_sound(estimate);
    EXPECT_EQ(estimate.tracking, Tracking::kTracking);
    EXPECT_EQ(estimate.resets, 1);
  }
  const Eigen::Vector3d moved = after.back().T_WS.T.p - after.front().T_WS.T.p;
  const Eigen::Vector3d truly = world().T_WS(39).p - world().T_WS(30).p;
  EXPECT_LT((moved - truly).norm(), 0.15 * truly.norm()) << "metric again, by the wearer";
  EXPECT_LT(position_error(after.front(), 30), 3.0 * position_std(after.front()))
      << "and no farther off than it says";
  EXPECT_GT(position_std(after.front()), 10.0 * position_std(before.back()))
      << "and it admits the way in the dark";
}

TEST(Recovery, AFewMatchesFarFromTheirPredictionsAreNotBelieved) {
  CollaborativeSlam slam = collaborative();
  run(slam, 0, 12);
  // Of the next image only a window around one landmark is left, 7 px to the right of where it was.
  const FrameBundle next = world().without_wearer(12);
  const auto predicted = slam.filter().predict_pixel(slam.filter().landmark_id(0));
  ASSERT_TRUE(predicted);
  FrameBundle window = in_the_dark(12);
  auto image = std::make_shared<GrayImage>(*window.image);
  constexpr int kHalf = 30;
  constexpr int kShift = 7;
  const int u = static_cast<int>(predicted->pixel.x());
  const int v = static_cast<int>(predicted->pixel.y());
  for (int y = std::max(0, v - kHalf); y < std::min(image->height, v + kHalf); ++y) {
    for (int x = std::max(0, u - kHalf); x < std::min(image->width - kShift, u + kHalf); ++x)
      image->row(y)[x + kShift] = next.image->row(y)[x];
  }
  window.image = image;
  const FrameEstimate estimate = slam.process(window);
  EXPECT_EQ(estimate.search.fused_pixels, 0);
  EXPECT_GT(estimate.search.chi_squared, 0);
}

TEST(Recovery, LostWithoutAWearerItGoesOnInTheUsualDepth) {
  SlamOptions options = world().options();
  options.mode = Mode::kMono;
  CollaborativeSlam slam(world().camera(), options);
  run(slam, 0, 12);
  for (int frame = 12; frame < 30; ++frame)
    slam.process(in_the_dark(frame));
  const auto after = run_without_wearer(slam, 30, 40);
  EXPECT_EQ(after.front().tracking, Tracking::kTracking);
  EXPECT_EQ(after.back().tracking, Tracking::kTracking);
  EXPECT_EQ(after.back().resets, 1);
}

}  // namespace
}  // namespace cosight::slam
