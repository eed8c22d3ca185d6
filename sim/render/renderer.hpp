#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

#include "shared/geometry/pose.hpp"
#include "sim/render/camera.hpp"
#include "sim/render/outline.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// What falls on the sensor: brightness 0 … 255, rows one after another.
struct Radiance {
  static constexpr std::uint16_t kSky = 0xffff;

  int width = 0;
  int height = 0;
  std::vector<float> brightness;
  std::vector<float> depth;         ///< z in the camera at the pixel's centre [m]; 0 where nothing is seen
  std::vector<std::uint16_t> quad;  ///< seen through the pixel's centre; kSky where none
};

/// Pose of the camera in the world, T_WC, while row `row` is exposed.
using RowPose = std::function<Pose(int row)>;

/// Casts a ray through every pixel onto the quads. In the camera, 1/z, s/z and t/z of a plane are linear in
/// the ray (x/z, y/z), so a ray costs six multiplications a plane, and only the nearest pays for its texture.
/// Pixels on the border of two quads are divided by four. Keeps its buffers: one renderer a thread.
class Renderer {
 public:
  explicit Renderer(const Camera& camera);

  const Camera& camera() const { return camera_; }

  /// Everything seen from one pose.
  const Radiance& render(std::span<const Quad> quads, const Pose& T_WC);

  /// A rolling shutter: each row from its own pose.
  const Radiance& render(std::span<const Quad> quads, const RowPose& T_WC_of_row);

 private:
  /// A quad as one row's camera sees it: each value is A x + B y + C of the ray (x, y, 1).
  struct Plane {
    Eigen::Vector3f inverse_z, s_over_z, t_over_z;
  };
  /// How the ray changes from a pixel to the next on the right, and to the next below.
  struct RayStep {
    Eigen::Vector2f right, down;
  };
  struct Tile {
    std::size_t first = 0, count = 0;  ///< in candidates_
  };

  void find_candidates(const Pose& T_WC, double movement);
  RayBox rays_of_tile(int tile_row, int tile_column) const;
  void set_planes(const Pose& T_WC);
  void find_winners(int row);
  void shade_row(int row, const Pose& T_WC);
  float shade_border(int row, int column, const Pose& T_WC) const;
  bool is_border(int row, int column) const;
  std::span<const std::uint16_t> candidates_at(int row, int column) const;
  std::uint16_t cast(std::span<const std::uint16_t> candidates, const Eigen::Vector2f& ray) const;
  RayStep ray_step(int row, int column) const;
  Texture::Filter filter_at(std::uint16_t visible, const Eigen::Vector2f& ray, const RayStep& step) const;
  float shade(std::uint16_t visible, const Eigen::Vector2f& ray, const Texture::Filter& filter,
              const Pose& T_WC) const;
  float reflection(const Quad& mirror, const Eigen::Vector3d& p_C, const Pose& T_WC) const;

  const Camera& camera_;
  int tile_columns_ = 0;
  Radiance radiance_;
  std::span<const Quad> quads_;
  std::vector<std::uint16_t> visible_;  ///< quads that face the camera, in its field of view
  std::vector<Outline> outlines_;       ///< of visible_
  std::vector<Plane> planes_;           ///< of visible_, for the row at work
  std::vector<Tile> tiles_;
  std::vector<std::uint16_t> candidates_;  ///< indices into visible_, tile after tile
  std::vector<std::uint16_t> winners_;     ///< index into visible_ of each pixel; kSky where none
};

}  // namespace cosight::sim
