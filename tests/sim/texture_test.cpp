#include "sim/world/texture.hpp"

#include <gtest/gtest.h>

namespace cosight::sim {
namespace {

GrayImage picture(int width, int height, int (*gray)(int x, int y)) {
  GrayImage image{width, height, {}};
  for (int y = 0; y < height; ++y) {
    for (int x = 0; x < width; ++x)
      image.data.push_back(static_cast<std::uint8_t>(gray(x, y)));
  }
  return image;
}

float sample(const Texture& texture, float u, float v, const Footprint& footprint) {
  return texture.sample(u, v, texture.filter_for(footprint));
}

TEST(Texture, GivesTheTexelAtItsCentre) {
  const Texture texture(picture(8, 8, [](int x, int y) { return 20 * x + 3 * y; }));
  EXPECT_NEAR(sample(texture, 2.5F, 4.5F, {}), 52.0F, 1e-3F);
}

TEST(Texture, IsLinearBetweenTexels) {
  const Texture texture(picture(16, 16, [](int x, int y) { return 10 * x + 4 * y; }));
  EXPECT_NEAR(sample(texture, 3.25F, 7.75F, {}), 10.0F * 2.75F + 4.0F * 7.25F, 0.1F);
}

TEST(Texture, StaysAtItsBorderOutside) {
  const Texture texture(picture(4, 4, [](int x, int /*y*/) { return 50 * x; }));
  EXPECT_NEAR(sample(texture, -5.0F, 2.0F, {}), 0.0F, 1e-3F);
  EXPECT_NEAR(sample(texture, 9.0F, 2.0F, {}), 150.0F, 1e-3F);
}

TEST(Texture, AveragesAPatternThatIsFinerThanThePixel) {
  const Texture texture(picture(64, 64, [](int x, int y) { return (x + y) % 2 == 0 ? 200 : 0; }));
  for (const float u : {20.1F, 20.7F, 33.3F}) {
    EXPECT_NEAR(sample(texture, u, 30.2F, {.du_dx = 8.0F, .dv_dy = 8.0F}), 100.0F, 2.0F);
  }
}

TEST(Texture, KeepsTheDetailAcrossASlantedSurface) {
  // Stripes across v, a footprint that is long along u only: they must stay.
  const Texture texture(picture(256, 64, [](int /*x*/, int y) { return y / 4 % 2 == 0 ? 200 : 0; }));
  const Footprint slanted{.du_dx = 8.0F, .dv_dx = 0.0F, .du_dy = 0.0F, .dv_dy = 1.0F};
  EXPECT_NEAR(sample(texture, 100.0F, 2.0F, slanted), 200.0F, 1.0F);
  EXPECT_NEAR(sample(texture, 100.0F, 6.0F, slanted), 0.0F, 1.0F);
}

}  // namespace
}  // namespace cosight::sim
