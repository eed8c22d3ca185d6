#include "sim/render/film.hpp"

#include <gtest/gtest.h>

#include <numeric>

#include "test_quads.hpp"

namespace cosight::sim {
namespace {

CameraModel lens() {
  return {.fx = 120, .fy = 120, .cx = 79.5, .cy = 59.5, .width = 160, .height = 120};
}

constexpr ExposurePlan kPerfect{.read_noise = 0.0, .shot_noise = 0.0, .vignetting = 0.0};

Radiance even_light(float brightness) {
  Radiance light{160, 120, {}, {}, {}};
  light.brightness.assign(160 * 120, brightness);
  return light;
}

TEST(Exposure, AddsNoiseOfTheSizeThatItSays) {
  const Exposure exposure({.read_noise = 3.0, .shot_noise = 0.4, .vignetting = 0.0}, 5);
  const GrayImage image = exposure.expose(even_light(100.0F), 0);
  double sum = 0.0;
  double squares = 0.0;
  for (const std::uint8_t gray : image.data) {
    sum += gray;
    squares += (gray - 100.0) * (gray - 100.0);
  }
  const double count = static_cast<double>(image.data.size());
  EXPECT_NEAR(sum / count, 100.0, 0.2);
  // 3^2 + 0.4^2 * 100 and a twelfth from rounding.
  EXPECT_NEAR(squares / count, 9.0 + 16.0 + 1.0 / 12.0, 1.0);
}

TEST(Exposure, DrawsOtherNoiseInEachFrameAndTheSameInOne) {
  const Exposure exposure({}, 5);
  const Radiance light = even_light(100.0F);
  EXPECT_EQ(exposure.expose(light, 3).data, exposure.expose(light, 3).data);
  EXPECT_NE(exposure.expose(light, 3).data, exposure.expose(light, 4).data);
}

TEST(Exposure, BringsADarkPictureToItsTarget) {
  ExposurePlan plan = kPerfect;
  plan.auto_exposure = 1.0;
  plan.target = 120.0;
  EXPECT_EQ(Exposure(plan, 1).expose(even_light(30.0F), 0).data[777], 120);
}

TEST(Exposure, DarkensTheCorners) {
  ExposurePlan plan = kPerfect;
  plan.vignetting = 0.5;
  const GrayImage image = Exposure(plan, 1).expose(even_light(200.0F), 0);
  EXPECT_NEAR(image.row(0)[0], 100, 2);
  EXPECT_NEAR(image.row(60)[80], 200, 1);
}

TEST(Film, BlursAnEdgeOverTheWayThatItMoves) {
  const Texture texture(gradient(200, 0));
  const Camera camera(lens());
  const Exposure exposure(kPerfect, 1);
  Film film(camera, exposure, {.exposure_time = 0.1, .readout_time = 0.0, .blur_steps = 20});
  Quad wall = wall_ahead(3.0, 4.0, texture);
  wall.origin.y() = 0.0;  // its left edge is in the middle of the picture
  const std::vector<Quad> quads{wall};
  // 2.5 m/s to the left: 10 px at 3 m in 0.1 s.
  const Motion motion = [](double time) {
    Pose T_WC = looking_ahead();
    T_WC.p.y() = 2.5 * time;
    return T_WC;
  };
  const GrayImage image = film.take(quads, motion, 0.0, 0);
  EXPECT_EQ(image.row(60)[73], 0);
  EXPECT_NEAR(image.row(60)[77], 200 * 0.25, 15);
  EXPECT_NEAR(image.row(60)[82], 200 * 0.75, 15);
  EXPECT_EQ(image.row(60)[86], 200);
}

}  // namespace
}  // namespace cosight::sim
