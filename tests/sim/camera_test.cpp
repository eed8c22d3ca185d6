#include "sim/render/camera.hpp"

#include <gtest/gtest.h>
#include <Eigen/Geometry>

#include <stdexcept>

namespace cosight::sim {
namespace {

CameraModel bent_lens() {
  CameraModel lens{.fx = 310, .fy = 305, .cx = 158, .cy = 122, .width = 320, .height = 240};
  lens.distortion = Distortion::kRadtan;
  lens.coefficients = {-0.25, 0.06, 0.001, -0.0007, 0.0};
  return lens;
}

TEST(Camera, FindsTheRayOfAPixelBack) {
  const Camera camera(bent_lens());
  for (const Eigen::Vector2d& pixel :
       {Eigen::Vector2d(0, 0), Eigen::Vector2d(319, 239), Eigen::Vector2d(17.5, 200.25)}) {
    const auto again = camera.pixel_of(2.5 * camera.ray_through(pixel).homogeneous());
    ASSERT_TRUE(again);
    EXPECT_NEAR((*again - pixel).norm(), 0.0, 1e-9);
  }
}

TEST(Camera, AgreesWithTheFiltersModelWhichIsWrittenApart) {
  const CameraModel lens = bent_lens();
  const Camera camera(lens);
  for (double x = -0.4; x <= 0.4; x += 0.1) {
    for (double y = -0.3; y <= 0.3; y += 0.1) {
      const Eigen::Vector3d p_C(3 * x, 3 * y, 3);
      EXPECT_NEAR((*camera.pixel_of(p_C) - *lens.project(p_C)).norm(), 0.0, 1e-9);
    }
  }
}

TEST(Camera, ListsTheRaysOfPixelCentres) {
  const Camera camera(CameraModel{.fx = 100, .fy = 50, .cx = 20, .cy = 10, .width = 40, .height = 30});
  const std::size_t k = 12 * 40 + 35;
  EXPECT_FLOAT_EQ(camera.rays_x()[k], 0.15F);
  EXPECT_FLOAT_EQ(camera.rays_y()[k], 0.04F);
}

TEST(Camera, RefusesALensItCannotRender) {
  CameraModel lens = bent_lens();
  lens.distortion = Distortion::kEquidistant;
  EXPECT_THROW(Camera{lens}, std::invalid_argument);
}

}  // namespace
}  // namespace cosight::sim
