#pragma once

#include <Eigen/Core>
#include <cstdint>
#include <vector>

#include "sim/world/material.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// A closed line of walls, the free space on its left: counter-clockwise around a room, clockwise around a
/// block that stands in it.
struct Walls {
  std::vector<Eigen::Vector2d> corners;  ///< on the floor, in W [m]
  Material material = Material::kPlaster;
  double decoration = 0.8;  ///< share of the walls that posters, doors, shelves take, 0 … 1
};

/// Part of a wall that is made of something else.
struct Patch {
  int outline = 0;              ///< which line of walls
  int wall = 0;                 ///< from its corner `wall` to the next
  double from = 0.0, to = 1.0;  ///< along it [m]
  double bottom = 0.5, top = 2.0;
  Material material = Material::kBlank;
  double decoration = 0.0;
  double reflectivity = 0.0;
};

/// A round column from the floor to the ceiling.
struct Pillar {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  double radius = 0.25;
  Material material = Material::kConcrete;
};

/// A piece of furniture that stands on the floor, or above it.
struct Box {
  Eigen::Vector2d centre = Eigen::Vector2d::Zero();
  Eigen::Vector3d size{1.0, 0.5, 0.8};  ///< along its own x, y and up [m]
  double yaw = 0.0;                     ///< [rad]
  double bottom = 0.0;                  ///< above the floor [m]
  Material material = Material::kWood;
};

/// A building of one storey.
struct FloorPlan {
  std::vector<Walls> outlines;
  std::vector<Patch> patches;
  std::vector<Pillar> pillars;
  std::vector<Box> boxes;
  Material floor = Material::kCarpet;
  Material ceiling = Material::kPanels;
  double height = 2.7;        ///< [m]
  double texel = 0.004;       ///< finest detail of the walls [m]
  double lamp_spacing = 3.0;  ///< of the ceiling lamps whose light lies on everything [m]
};

/// Draws and lights the building. The same plan and seed give the same scene.
Scene build_scene(const FloorPlan& plan, std::uint64_t seed);

}  // namespace cosight::sim
