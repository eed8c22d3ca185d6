#include "tools/prepare/lens_change.hpp"

#include <gtest/gtest.h>

#include <cmath>

namespace cosight {
namespace {

/// A picture of the smooth pattern f(ray) as the camera would take it.
GrayImage picture(const CameraModel& camera) {
  GrayImage image{camera.width, camera.height, {}};
  image.data.resize(static_cast<std::size_t>(camera.width) * static_cast<std::size_t>(camera.height));
  for (int y = 0; y < camera.height; ++y) {
    for (int x = 0; x < camera.width; ++x) {
      const auto ray = camera.unproject({x, y});
      const double f = ray ? 128.0 + 60.0 * std::sin(9.0 * ray->x()) + 50.0 * std::cos(7.0 * ray->y()) : 0.0;
      image.row(y)[x] = static_cast<std::uint8_t>(std::lround(f));
    }
  }
  return image;
}

TEST(LensChange, ShowsWhatTheOtherLensWouldHaveSeen) {
  const CameraModel from{200, 201, 160, 118, 320, 240, Distortion::kRadtan, {-0.28, 0.07, 1e-3, -5e-4, 0.0}};
  const CameraModel to{203, 199, 155, 124, 320, 240, Distortion::kRadtan, {-0.25, 0.06, -1e-3, 2e-4, 0.0}};
  const GrayImage changed = with_other_lens(picture(from), from, to);
  const GrayImage expected = picture(to);
  ASSERT_EQ(changed.data.size(), expected.data.size());
  for (int y = 12; y < to.height - 12; ++y) {
    for (int x = 12; x < to.width - 12; ++x) {
      ASSERT_NEAR(changed.row(y)[x], expected.row(y)[x], 2) << x << ' ' << y;
    }
  }
}

TEST(LensChange, ToTheSameLensChangesNothing) {
  const CameraModel camera{200, 200, 31.5, 23.5, 64, 48, Distortion::kNone, {}};
  const GrayImage image = picture(camera);
  EXPECT_EQ(with_other_lens(image, camera, camera).data, image.data);
}

}  // namespace
}  // namespace cosight
