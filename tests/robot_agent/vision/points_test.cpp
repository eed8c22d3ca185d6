#include <gtest/gtest.h>

#include <Eigen/LU>
#include <cmath>
#include <vector>

#include "robot_agent/vision/corner_detector.hpp"
#include "robot_agent/vision/point_tracker.hpp"
#include "tests/robot_agent/vision/synthetic_texture.hpp"

namespace cosight::vision {
namespace {

TEST(CornerDetector, KeepsItsDistances) {
  const GrayImage image = SyntheticTexture(1).render(320, 240);
  const std::vector<Eigen::Vector2d> occupied{{100, 100}, {200, 50}};
  const CornerOptions options;
  const std::vector<Corner> corners = CornerDetector(options).detect(image, occupied, 80);
  ASSERT_GT(corners.size(), 40U);
  ASSERT_LE(corners.size(), 80U);
  for (std::size_t i = 0; i < corners.size(); ++i) {
    const Eigen::Vector2d& pixel = corners[i].pixel;
    EXPECT_GE(pixel.x(), options.border);
    EXPECT_LT(pixel.x(), 320 - options.border);
    EXPECT_GE(pixel.y(), options.border);
    EXPECT_LT(pixel.y(), 240 - options.border);
    for (const Eigen::Vector2d& other : occupied)
      EXPECT_GE((pixel - other).norm(), options.min_distance);
    for (std::size_t k = 0; k < i; ++k)
      EXPECT_GE((pixel - corners[k].pixel).norm(), options.min_distance);
  }
}

TEST(CornerDetector, FillsTheEmptyPartFirst) {
  const GrayImage image = SyntheticTexture(1).render(320, 240);
  std::vector<Eigen::Vector2d> occupied;
  for (int x = 20; x < 160; x += 20) {
    for (int y = 20; y < 240; y += 20)
      occupied.emplace_back(x, y);
  }
  for (const Corner& corner : CornerDetector().detect(image, occupied, 6))
    EXPECT_GE(corner.pixel.x(), 160.0);
}

TEST(CornerDetector, StaysInsideThePolygon) {
  const GrayImage image = SyntheticTexture(1).render(320, 240);
  const ConvexPolygon triangle{{40, 40}, {250, 60}, {120, 200}};
  const std::vector<Corner> corners = CornerDetector().detect(image, {}, 50, &triangle);
  ASSERT_GT(corners.size(), 5U);
  for (const Corner& corner : corners)
    EXPECT_TRUE(contains(triangle, corner.pixel));
  const ConvexPolygon elsewhere{{400, 40}, {500, 60}, {420, 200}};
  EXPECT_TRUE(CornerDetector().detect(image, {}, 50, &elsewhere).empty());
  const ConvexPolygon empty;
  EXPECT_TRUE(CornerDetector().detect(image, {}, 50, &empty).empty());
}

TEST(CornerDetector, FindsTheCornersOfASquareAndNotItsEdges) {
  GrayImage image{100, 100, std::vector<std::uint8_t>(10000, 40)};
  for (int y = 30; y < 70; ++y)
    std::fill(image.row(y) + 30, image.row(y) + 70, std::uint8_t{200});
  const std::vector<Corner> corners = CornerDetector().detect(image, {}, 10);
  ASSERT_EQ(corners.size(), 4U);
  for (const Corner& corner : corners) {
    EXPECT_NEAR(std::abs(corner.pixel.x() - 49.5), 19.5, 2.0);
    EXPECT_NEAR(std::abs(corner.pixel.y() - 49.5), 19.5, 2.0);
  }
  EXPECT_LT(shi_tomasi_score(image, 30, 50), 1.0);
}

TEST(CornerDetector, FindsNothingInAnImageSmallerThanItsBorder) {
  EXPECT_TRUE(CornerDetector().detect(SyntheticTexture(1).render(15, 15), {}, 10).empty());
}

struct Moved {
  GrayImage first;
  GrayImage second;
};

Moved moved_by(const Eigen::Vector2d& motion) {
  const SyntheticTexture texture(9);
  return {texture.render(320, 240),
          texture.render(320, 240, [&](const Eigen::Vector2d& u) { return u - motion; })};
}

TEST(PointTracker, FollowsAShiftToATenthOfAPixel) {
  const Eigen::Vector2d motion(7.3, -4.6);
  const Moved images = moved_by(motion);
  PointTracker tracker;
  tracker.advance(images.first);
  tracker.advance(images.second);
  std::vector<TrackStart> starts;
  std::vector<Patch> patches;
  for (const Corner& corner : CornerDetector().detect(images.first, {}, 60)) {
    starts.push_back({corner.pixel, corner.pixel, nullptr});
    patches.push_back(cut_patch(images.first, corner.pixel, 13));
  }
  for (std::size_t i = 0; i < starts.size(); ++i)
    starts[i].first = &patches[i];
  int tracked = 0;
  const std::vector<Track> tracks = tracker.track(starts);
  for (std::size_t i = 0; i < starts.size(); ++i) {
    if (!tracks[i]) continue;
    ++tracked;
    EXPECT_LT((tracks[i].pixel - starts[i].previous - motion).norm(), 0.1);
    EXPECT_GT(tracks[i].score, 0.95);
  }
  EXPECT_GE(tracked, static_cast<int>(0.9 * static_cast<double>(starts.size())));
}

TEST(PointTracker, FollowsFarMotionFromAPrediction) {
  const Eigen::Vector2d motion(70.0, 5.0);
  const Moved images = moved_by(motion);
  PointTracker tracker;
  tracker.advance(images.first);
  tracker.advance(images.second);
  const Eigen::Vector2d pixel = CornerDetector().detect(images.first, {}, 1, nullptr).front().pixel;
  const Eigen::Vector2d start(std::min(pixel.x(), 200.0), pixel.y());
  const Track track = tracker.track({{start, start + Eigen::Vector2d(66.0, 2.0), nullptr}}).front();
  ASSERT_TRUE(track);
  EXPECT_LT((track.pixel - start - motion).norm(), 0.1);
}

TEST(PointTracker, NoticesThatThePatchHasChanged) {
  const Moved images = moved_by({2.0, 1.0});
  const Patch other = cut_patch(SyntheticTexture(77).render(60, 60), {30, 30}, 13);
  PointTracker tracker;
  tracker.advance(images.first);
  tracker.advance(images.second);
  const Track track = tracker.track({{{150, 120}, {150, 120}, &other}}).front();
  EXPECT_EQ(track.outcome, TrackOutcome::kChanged);
}

TEST(PointTracker, NoticesThatItDoesNotComeBack) {
  const SyntheticTexture texture(9);
  PointTracker tracker;
  tracker.advance(texture.render(320, 240));
  tracker.advance(SyntheticTexture(10).render(320, 240));
  int tracked = 0;
  for (int x = 60; x < 260; x += 20) {
    const Track track = tracker.track({{{1.0 * x, 120}, {1.0 * x, 120}, nullptr}}).front();
    tracked += track ? 1 : 0;
  }
  EXPECT_LE(tracked, 2);
}

TEST(PointTracker, NeedsTwoFramesOfOneSize) {
  const SyntheticTexture texture(9);
  const TrackStart start{{60, 60}, {60, 60}, nullptr};
  PointTracker tracker;
  EXPECT_FALSE(tracker.track({start}).front());
  tracker.advance(texture.render(320, 240));
  EXPECT_FALSE(tracker.track({start}).front());
  tracker.advance(texture.render(160, 120));
  EXPECT_FALSE(tracker.track({start}).front());
  tracker.advance(texture.render(160, 120));
  EXPECT_TRUE(tracker.track({start}).front());
}

}  // namespace
}  // namespace cosight::vision
