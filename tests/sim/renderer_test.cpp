#include "sim/render/renderer.hpp"

#include <gtest/gtest.h>

#include "test_quads.hpp"

namespace cosight::sim {
namespace {

CameraModel lens() {
  return {.fx = 120, .fy = 120, .cx = 79.5, .cy = 59.5, .width = 160, .height = 120};
}

std::size_t at(const Radiance& light, int x, int y) {
  return static_cast<std::size_t>(y) * static_cast<std::size_t>(light.width) + static_cast<std::size_t>(x);
}

/// The gray of `gradient(20, 1)` on `wall_ahead(distance, size)` at a place y to the left of the axis.
double gray_at(double y, double size) {
  return 20.0 + 200.0 * (0.5 - y / size);
}

TEST(Renderer, ShowsAPlaneAsTheClosedFormSays) {
  const Texture texture(gradient(20, 1));
  const Camera camera(lens());
  Renderer renderer(camera);
  const std::vector<Quad> quads{wall_ahead(3.0, 8.0, texture)};
  const Radiance& light = renderer.render(quads, looking_ahead());
  for (const int x : {0, 13, 79, 80, 131, 159}) {
    for (const int y : {0, 59, 119}) {
      const double left = -3.0 * (x - 79.5) / 120.0;  // y_W of the place that the pixel shows
      EXPECT_NEAR(static_cast<double>(light.brightness[at(light, x, y)]), gray_at(left, 8.0), 0.6)
          << x << ' ' << y;
      EXPECT_NEAR(static_cast<double>(light.depth[at(light, x, y)]), 3.0, 1e-5);
    }
  }
}

TEST(Renderer, ShowsASlantedPlaneInPerspective) {
  const Texture texture(gradient(20, 1));
  const Camera camera(lens());
  Renderer renderer(camera);
  const std::vector<Quad> quads{wall_ahead(3.0, 12.0, texture)};
  const double yaw = 0.6;
  const Radiance& light = renderer.render(quads, optical_mount({0.5, -0.2, 0.3}, yaw, 0.1));
  for (const int x : {5, 60, 100, 155}) {
    for (const int y : {10, 60, 110}) {
      // The ray in W by hand: forward, left and up of a camera that is turned left by yaw and up by 0.1.
      const double forward = std::cos(0.1) + std::sin(0.1) * (y - 59.5) / 120.0;
      const Eigen::Vector3d ray(std::cos(yaw) * forward + std::sin(yaw) * (x - 79.5) / 120.0,
                                std::sin(yaw) * forward - std::cos(yaw) * (x - 79.5) / 120.0, 0.0);
      const double z = (3.0 - 0.5) / ray.x();
      EXPECT_NEAR(static_cast<double>(light.depth[at(light, x, y)]), z, 1e-4 * z);
      EXPECT_NEAR(static_cast<double>(light.brightness[at(light, x, y)]), gray_at(-0.2 + z * ray.y(), 12.0),
                  0.8);
    }
  }
}

TEST(Renderer, BendsStraightEdgesAsTheLensDoes) {
  CameraModel bent = lens();
  bent.distortion = Distortion::kRadtan;
  bent.coefficients = {-0.3, 0.08, 0.001, -0.002, 0.0};
  const Texture texture(gradient(200, 0));
  const Camera camera(bent);
  Renderer renderer(camera);
  const std::vector<Quad> quads{wall_ahead(3.0, 2.6, texture)};
  const Radiance& light = renderer.render(quads, looking_ahead());
  int checked = 0;
  for (double up = -1.2; up <= 1.2; up += 0.2) {
    // The wall's right edge at this height; project with the other implementation of the lens.
    const Eigen::Vector2d edge = *bent.project({1.3, -up, 3.0});
    const int y = static_cast<int>(std::lround(edge.y()));
    const int inside = static_cast<int>(std::floor(edge.x() - 1.0));
    EXPECT_GT(light.brightness[at(light, inside, y)], 190.0F) << up;
    EXPECT_LT(light.brightness[at(light, inside + 3, y)], 10.0F) << up;
    ++checked;
  }
  EXPECT_GT(checked, 10);
}

TEST(Renderer, SmoothsAnEdgeByTheShareOfThePixelThatItCovers) {
  const Texture texture(gradient(200, 0));
  const Camera camera(lens());
  Renderer renderer(camera);
  Quad wall = wall_ahead(3.0, 2.0, texture);
  wall.edge_s.y() = -(1.0 + 3.0 * 0.5 / 120.0);  // its right edge is at the centre of pixel 80
  const std::vector<Quad> quads{wall};
  const Radiance& light = renderer.render(quads, looking_ahead());
  EXPECT_NEAR(light.brightness[at(light, 80, 60)], 100.0F, 1.0F);
  EXPECT_NEAR(light.brightness[at(light, 79, 60)], 200.0F, 1e-2F);
  EXPECT_NEAR(light.brightness[at(light, 81, 60)], 0.0F, 1e-2F);
}

TEST(Renderer, HidesWhatIsBehind) {
  const Texture far_texture(gradient(50, 0));
  const Texture near_texture(gradient(150, 0));
  const Camera camera(lens());
  Renderer renderer(camera);
  const std::vector<Quad> quads{wall_ahead(2.0, 0.5, near_texture), wall_ahead(5.0, 20.0, far_texture)};
  const Radiance& light = renderer.render(quads, looking_ahead());
  EXPECT_EQ(light.quad[at(light, 80, 60)], 0);
  EXPECT_EQ(light.quad[at(light, 110, 60)], 1);
  EXPECT_NEAR(light.brightness[at(light, 80, 60)], 150.0F, 1e-2F);
  EXPECT_NEAR(light.brightness[at(light, 110, 60)], 50.0F, 1e-2F);
}

TEST(Renderer, MirrorsInAReflectiveQuad) {
  const Texture dark(gradient(40, 0));
  const Texture bright(gradient(220, 0));
  const Camera camera(lens());
  Renderer renderer(camera);
  Quad mirror = wall_ahead(2.0, 10.0, dark);
  mirror.reflectivity = 0.5F;
  Quad behind = wall_ahead(3.0, 20.0, bright);  // turned around: faces the mirror from behind the camera
  behind.origin = {-3.0, -10.0, 10.0};
  behind.edge_s = {0.0, 20.0, 0.0};
  const std::vector<Quad> quads{mirror, behind};
  const Radiance& light = renderer.render(quads, looking_ahead());
  EXPECT_NEAR(light.brightness[at(light, 80, 60)], 0.5F * 40.0F + 0.5F * 220.0F, 0.1F);
}

TEST(Renderer, ReadsRowsOneAfterTheOtherUnderARollingShutter) {
  const Texture texture(gradient(20, 1));
  const Camera camera(lens());
  Renderer renderer(camera);
  const std::vector<Quad> quads{wall_ahead(3.0, 8.0, texture)};
  const auto pose_of_row = [](int row) {
    Pose T_WC = looking_ahead();
    T_WC.p.y() = 0.002 * (row - 60);  // moves to the left while the rows are read
    return T_WC;
  };
  const Radiance& light = renderer.render(quads, RowPose(pose_of_row));
  for (const int row : {0, 30, 90, 119}) {
    EXPECT_NEAR(static_cast<double>(light.brightness[at(light, 100, row)]),
                gray_at(0.002 * (row - 60) - 3.0 * 20.5 / 120.0, 8.0), 0.6);
  }
}

}  // namespace
}  // namespace cosight::sim
