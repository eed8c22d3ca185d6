#include "sim/world/floor_plan.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <stdexcept>
#include <string>

#include "sim/random.hpp"
#include "sim/world/decorations.hpp"
#include "sim/world/lighting.hpp"
#include "sim/world/materials.hpp"
#include "sim/world/sheet.hpp"
#include "sim/world/solids.hpp"

namespace cosight::sim {
namespace {

struct Bounds {
  Eigen::Vector2d low, high;
};

Bounds bounds_of(const FloorPlan& plan) {
  if (plan.outlines.empty()) throw std::invalid_argument("a world needs at least one outline of walls");
  Bounds bounds{Eigen::Vector2d::Constant(1e9), Eigen::Vector2d::Constant(-1e9)};
  for (const Walls& walls : plan.outlines) {
    for (const Eigen::Vector2d& corner : walls.corners) {
      bounds.low = bounds.low.cwiseMin(corner);
      bounds.high = bounds.high.cwiseMax(corner);
    }
  }
  return bounds;
}

/// Adds one surface after the other, each with a picture of its own.
class Builder {
 public:
  Builder(const FloorPlan& plan, std::uint64_t seed)
      : plan_(plan),
        seed_(seed),
        bounds_(bounds_of(plan)),
        lighting_(bounds_.low, bounds_.high, plan.height - 0.05, plan.lamp_spacing) {}

  Scene build() {
    add_floor_and_ceiling();
    for (const Walls& walls : plan_.outlines) {
      for (std::size_t k = 0; k < walls.corners.size(); ++k) {
        add(wall_quad(walls, k), walls.material, walls.decoration, plan_.texel);
      }
    }
    for (const Patch& patch : plan_.patches)
      add_patch(patch);
    for (const Pillar& pillar : plan_.pillars) {
      add_ring(pillar);
    }
    for (const Box& box : plan_.boxes) {
      const Pose T_WX{Eigen::Quaterniond(Eigen::AngleAxisd(box.yaw, Eigen::Vector3d::UnitZ())),
                      {box.centre.x(), box.centre.y(), box.bottom}};
      for (const Quad& side : box_sides(T_WX, box.size))
        add(side, box.material, 0.0, plan_.texel);
    }
    return std::move(scene_);
  }

 private:
  void add(Quad quad, Material material, double decoration, double texel) {
    RandomStream random(seed_, "surface", scene_.quads.size());
    cv::Mat picture = paint_material(material, quad.edge_s.norm(), quad.edge_t.norm(), texel, random);
    if (decoration > 0.0) {
      decorate_wall(picture, texel, decoration, RandomStream(seed_, "decoration", scene_.quads.size()));
    }
    lighting_.bake(quad, picture);
    scene_.quads.push_back(wearing(quad, sheet_of(scene_, picture)));
  }

  Quad wall_quad(const Walls& walls, std::size_t k) const {
    const Eigen::Vector2d& from = walls.corners[k];
    const Eigen::Vector2d& to = walls.corners[(k + 1) % walls.corners.size()];
    // The free space is on the left of from -> to, so whoever looks at the wall has `to` on the left.
    Quad quad;
    quad.origin = {to.x(), to.y(), plan_.height};
    quad.edge_s = {from.x() - to.x(), from.y() - to.y(), 0.0};
    quad.edge_t = {0.0, 0.0, -plan_.height};
    return quad;
  }

  void add_floor_and_ceiling() {
    const Eigen::Vector2d size = bounds_.high - bounds_.low;
    Quad floor;
    floor.origin = {bounds_.low.x(), bounds_.high.y(), 0.0};
    floor.edge_s = {size.x(), 0.0, 0.0};
    floor.edge_t = {0.0, -size.y(), 0.0};
    add(floor, plan_.floor, 0.0, 1.25 * plan_.texel);
    Quad ceiling;
    ceiling.origin = {bounds_.low.x(), bounds_.low.y(), plan_.height};
    ceiling.edge_s = {size.x(), 0.0, 0.0};
    ceiling.edge_t = {0.0, size.y(), 0.0};
    add(ceiling, plan_.ceiling, 0.0, 2.0 * plan_.texel);
  }

  void add_patch(const Patch& patch) {
    const auto outline = static_cast<std::size_t>(patch.outline);
    if (patch.outline < 0 || outline >= plan_.outlines.size() || patch.wall < 0 ||
        static_cast<std::size_t>(patch.wall) >= plan_.outlines[outline].corners.size()) {
      throw std::invalid_argument("a patch is on wall " + std::to_string(patch.wall) + " of outline " +
                                  std::to_string(patch.outline) + ", which does not exist");
    }
    const Quad wall = wall_quad(plan_.outlines[outline], static_cast<std::size_t>(patch.wall));
    const Eigen::Vector3d along = wall.edge_s.normalized();
    constexpr double kBeforeWall = 0.01;  // [m]
    Quad quad;
    // `from` and `to` count from the corner `wall`, which is the far end of s.
    quad.origin = wall.origin + along * (wall.edge_s.norm() - patch.to) -
                  Eigen::Vector3d(0, 0, plan_.height - patch.top) -
                  kBeforeWall * wall.inward_normal().normalized();
    quad.edge_s = along * (patch.to - patch.from);
    quad.edge_t = {0.0, 0.0, patch.bottom - patch.top};
    quad.reflectivity = static_cast<float>(patch.reflectivity);
    add(quad, patch.material, patch.decoration, plan_.texel);
  }

  /// One picture wound around the column.
  void add_ring(const Pillar& pillar) {
    const double around = 2.0 * std::numbers::pi * pillar.radius;
    cv::Mat picture = paint_material(pillar.material, around, plan_.height, plan_.texel,
                                     RandomStream(seed_, "surface", scene_.quads.size()));
    RandomStream random(seed_, "pillar posters", scene_.quads.size());
    draw_poster(picture, {picture.cols / 5, picture.rows / 3, picture.cols / 4, picture.rows / 6}, random);
    draw_poster(picture, {picture.cols * 3 / 5, picture.rows * 2 / 5, picture.cols / 5, picture.rows / 5},
                random);
    const Quad sheet = sheet_of(scene_, picture);
    const Pose T_WX{Eigen::Quaterniond::Identity(), {pillar.centre.x(), pillar.centre.y(), 0.0}};
    for (Quad& side : ring_sides(T_WX, pillar.radius, plan_.height, 20, sheet)) {
      const Eigen::Vector3d middle = side.origin + 0.5 * (side.edge_s + side.edge_t);
      side.shade = static_cast<float>(lighting_.at(middle, -side.inward_normal().normalized()));
      scene_.quads.push_back(side);
    }
  }

  const FloorPlan& plan_;
  std::uint64_t seed_;
  Bounds bounds_;
  Lighting lighting_;
  Scene scene_;
};

}  // namespace

Scene build_scene(const FloorPlan& plan, std::uint64_t seed) {
  return Builder(plan, seed).build();
}

}  // namespace cosight::sim
