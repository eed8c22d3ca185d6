#include "sim/scenario_file.hpp"

#include <cmath>
#include <numbers>
#include <string>

#include "sim/sensor_plans_file.hpp"

namespace cosight::sim {
namespace {

constexpr double kDegree = std::numbers::pi / 180.0;

Material read_material(const ConfigNode& node, std::string_view key, Material otherwise) {
  return node.choice(key, otherwise,
                     {{"plaster", Material::kPlaster},
                      {"concrete", Material::kConcrete},
                      {"brick", Material::kBrick},
                      {"tiles", Material::kTiles},
                      {"wallpaper", Material::kWallpaper},
                      {"carpet", Material::kCarpet},
                      {"wood", Material::kWood},
                      {"panels", Material::kPanels},
                      {"fabric", Material::kFabric},
                      {"blank", Material::kBlank}});
}

/// `[[x, y], …]`
std::vector<Eigen::Vector2d> read_points(const ConfigNode& node, std::string_view key, std::size_t fewest) {
  const std::vector<double> flat = node.numbers(key, {});
  if (flat.size() % 2 != 0 || flat.size() < 2 * fewest) {
    throw node.error(key, "has to be " + std::to_string(fewest) + " or more points, as [[0, 0], [4, 0]]");
  }
  std::vector<Eigen::Vector2d> points;
  for (std::size_t k = 0; k + 1 < flat.size(); k += 2)
    points.emplace_back(flat[k], flat[k + 1]);
  return points;
}

Eigen::Vector2d read_point(const ConfigNode& node, std::string_view key) {
  const std::vector<double> flat = node.numbers(key, {0.0, 0.0});
  if (flat.size() != 2) throw node.error(key, "has to be a point, as [1.5, 2]");
  return {flat[0], flat[1]};
}

/// `[[time, value], …]`
std::vector<Keyframe> read_keyframes(const ConfigNode& node, std::string_view key, double otherwise,
                                     double unit) {
  const std::vector<double> flat = node.numbers(key, {0.0, otherwise});
  std::vector<Keyframe> keyframes;
  if (flat.size() % 2 != 0)
    throw node.error(key, "has to be pairs of time and value, as [[0, 1.5], [4, -1]]");
  for (std::size_t k = 0; k + 1 < flat.size(); k += 2) {
    if (!keyframes.empty() && flat[k] <= keyframes.back().time)
      throw node.error(key, "has times that do not grow");
    keyframes.push_back({flat[k], flat[k + 1] * unit});
  }
  return keyframes;
}

Walls read_walls(const ConfigNode& node) {
  Walls walls;
  walls.corners = read_points(node, "corners_m", 3);
  walls.material = read_material(node, "material", walls.material);
  walls.decoration = node.number("decoration", walls.decoration, 0.0, 1.0);
  return walls;
}

Patch read_patch(const ConfigNode& node) {
  Patch patch;
  patch.outline = node.integer("outline", patch.outline, 0);
  patch.wall = node.integer("wall", patch.wall, 0);
  patch.from = node.number("from_m", patch.from, 0.0);
  patch.to = node.number("to_m", patch.to, patch.from + 0.01);
  patch.bottom = node.number("bottom_m", patch.bottom, 0.0);
  patch.top = node.number("top_m", patch.top, patch.bottom + 0.01);
  patch.material = read_material(node, "material", patch.material);
  patch.decoration = node.number("decoration", patch.decoration, 0.0, 1.0);
  patch.reflectivity = node.number("reflectivity", patch.reflectivity, 0.0, 1.0);
  return patch;
}

Pillar read_pillar(const ConfigNode& node) {
  Pillar pillar;
  pillar.centre = read_point(node, "centre_m");
  pillar.radius = node.number("radius_m", pillar.radius, 0.02, 5.0);
  pillar.material = read_material(node, "material", pillar.material);
  return pillar;
}

Box read_box(const ConfigNode& node) {
  Box box;
  box.centre = read_point(node, "centre_m");
  box.size = node.vector3("size_m", box.size, 0.01, 50.0);
  box.yaw = kDegree * node.number("yaw_deg", 0.0);
  box.bottom = node.number("bottom_m", box.bottom, 0.0, 10.0);
  box.material = read_material(node, "material", box.material);
  return box;
}

FloorPlan read_world(const ConfigNode& node) {
  FloorPlan plan;
  for (const ConfigNode& each : node.sections("outlines"))
    plan.outlines.push_back(read_walls(each));
  if (plan.outlines.empty())
    throw node.error("outlines", "is missing: a world needs one closed line of walls or more");
  for (const ConfigNode& each : node.sections("patches"))
    plan.patches.push_back(read_patch(each));
  for (const ConfigNode& each : node.sections("pillars"))
    plan.pillars.push_back(read_pillar(each));
  for (const ConfigNode& each : node.sections("boxes"))
    plan.boxes.push_back(read_box(each));
  plan.floor = read_material(node, "floor", plan.floor);
  plan.ceiling = read_material(node, "ceiling", plan.ceiling);
  plan.height = node.number("height_m", plan.height, 0.5, 20.0);
  plan.texel = node.number("texel_m", plan.texel, 0.001, 0.1);
  plan.lamp_spacing = node.number("lamp_spacing_m", plan.lamp_spacing, 0.5, 50.0);
  return plan;
}

PathPlan read_path(const ConfigNode& node) {
  PathPlan path;
  path.waypoints = read_points(node, "waypoints_m", 2);
  path.corner_radius = node.number("corner_radius_m", path.corner_radius, 0.01, 100.0);
  path.speed = node.number("speed_mps", path.speed, 0.01, 10.0);
  path.ramp = node.number("ramp_s", path.ramp, 0.1, 60.0);
  path.wait = node.number("wait_s", path.wait, 0.0, 600.0);
  return path;
}

WearerPlan read_wearer(const ConfigNode& node) {
  WearerPlan wearer;
  wearer.ahead = read_keyframes(node, "ahead_m", 1.0, 1.0);
  wearer.left = read_keyframes(node, "left_m", 0.6, 1.0);
  wearer.gaze_left = read_keyframes(node, "gaze_left_deg", 0.0, kDegree);
  wearer.gaze_up = read_keyframes(node, "gaze_up_deg", 0.0, kDegree);
  wearer.head_height = node.number("head_height_m", wearer.head_height, 0.5, 2.5);
  wearer.step_length = node.number("step_length_m", wearer.step_length, 0.2, 2.0);
  wearer.bob = node.number("bob_m", wearer.bob, 0.0, 0.2);
  wearer.sway = node.number("sway_m", wearer.sway, 0.0, 0.2);
  wearer.nod = kDegree * node.number("nod_deg", wearer.nod / kDegree, 0.0, 20.0);
  wearer.glance = kDegree * node.number("glance_deg", wearer.glance / kDegree, 0.0, 60.0);
  return wearer;
}

AhrsPlan read_ahrs(const ConfigNode& node) {
  AhrsPlan ahrs;
  ahrs.timing = read_timing(node, ahrs.timing);
  ahrs.roll_pitch_sigma =
      kDegree * node.number("roll_pitch_sigma_deg", ahrs.roll_pitch_sigma / kDegree, 0.0, 30.0);
  ahrs.yaw_sigma = kDegree * node.number("yaw_sigma_deg", ahrs.yaw_sigma / kDegree, 0.0, 90.0);
  ahrs.wander_time = node.number("wander_time_s", ahrs.wander_time, 0.01, 1e4);
  ahrs.white_sigma = kDegree * node.number("white_sigma_deg", ahrs.white_sigma / kDegree, 0.0, 10.0);
  ahrs.north_offset = kDegree * node.number("north_offset_deg", 0.0, -180.0, 180.0);
  ahrs.disturbance = kDegree * node.number("disturbance_deg", 0.0, 0.0, 90.0);
  ahrs.disturbance_time = node.number("disturbance_time_s", ahrs.disturbance_time, 1.0, 1e4);
  return ahrs;
}

GazePlan read_gaze(const ConfigNode& node) {
  GazePlan gaze;
  gaze.ratio = node.number("ratio", gaze.ratio, 0.0, 1.0);
  gaze.intervals = node.integer("intervals", gaze.intervals, 1, 1000);
  gaze.aside = kDegree * node.number("aside_deg", gaze.aside / kDegree, 0.0, 180.0);
  gaze.turn_time = node.number("turn_s", gaze.turn_time, 0.05, 10.0);
  return gaze;
}

LaserPlan read_laser(const ConfigNode& node, const Eigen::Vector3d& otherwise_at, double otherwise_yaw) {
  LaserPlan laser;
  laser.timing = read_timing(node, laser.timing);
  laser.points = node.integer("points", laser.points, 2, 10000);
  laser.arc = kDegree * node.number("arc_deg", laser.arc / kDegree, 1.0, 360.0);
  laser.range_min = node.number("range_min_m", laser.range_min, 0.0, 100.0);
  laser.range_max = node.number("range_max_m", laser.range_max, laser.range_min, 500.0);
  laser.sigma = node.number("sigma_m", laser.sigma, 0.0, 1.0);
  laser.bias = node.number("bias_m", laser.bias, -1.0, 1.0);
  laser.miss = node.number("miss", laser.miss, 0.0, 1.0);
  const double yaw = kDegree * node.number("yaw_deg", otherwise_yaw);
  laser.T_BL = {Eigen::Quaterniond(Eigen::AngleAxisd(yaw, Eigen::Vector3d::UnitZ())),
                node.vector3("at_m", otherwise_at)};
  return laser;
}

OdometryPlan read_odometry(const ConfigNode& node) {
  OdometryPlan odometry;
  odometry.timing = read_timing(node, odometry.timing);
  odometry.scale_sigma = node.number("scale_sigma", odometry.scale_sigma, 0.0, 1.0);
  odometry.turn_scale_sigma = node.number("turn_scale_sigma", odometry.turn_scale_sigma, 0.0, 1.0);
  odometry.slip = node.number("slip", odometry.slip, 0.0, 1.0);
  odometry.turn_slip = node.number("turn_slip", odometry.turn_slip, 0.0, 1.0);
  return odometry;
}

TrackerPlan read_tracker(const ConfigNode& node) {
  TrackerPlan tracker;
  tracker.position_sigma = node.vector3("position_sigma_m", tracker.position_sigma, 0.0, 1.0);
  tracker.rotation_sigma =
      kDegree * node.vector3("rotation_sigma_deg", tracker.rotation_sigma / kDegree, 0.0, 30.0);
  return tracker;
}

}  // namespace

Scenario read_scenario(const ConfigNode& root) {
  Scenario scenario;
  scenario.name = root.text("name", scenario.name);
  scenario.duration = root.number("duration_s", scenario.duration, 0.0, 36000.0);
  scenario.known_points = root.integer("known_points", scenario.known_points, 0, 500);
  scenario.plan = read_world(root.section("world"));
  const ConfigNode robot = root.section("robot");
  scenario.path = read_path(robot.section("path"));
  scenario.shaking.height = robot.number("shaking_height_m", scenario.shaking.height, 0.0, 0.1);
  scenario.shaking.angle = kDegree * robot.number("shaking_deg", scenario.shaking.angle / kDegree, 0.0, 10.0);
  scenario.robot_camera = read_camera(robot.section("camera"), scenario.robot_camera, {0.1, 0.0, 0.85});
  scenario.front_laser = read_laser(robot.section("front_laser"), {0.2, 0.0, 0.3}, 0.0);
  scenario.rear_laser = read_laser(robot.section("rear_laser"), {-0.3, 0.0, 0.3}, 180.0);
  scenario.imu = read_imu(robot.section("imu"));
  scenario.odometry = read_odometry(robot.section("odometry"));
  for (const ConfigNode& person : root.sections("passers_by"))
    scenario.passers_by.push_back(read_path(person));
  const ConfigNode wearer = root.section("wearer");
  scenario.gaze = read_gaze(wearer.section("overlap"));
  scenario.wearer = read_wearer(wearer);
  scenario.wearer_camera = read_camera(wearer.section("camera"), scenario.wearer_camera, {0.11, 0.0, 0.06});
  scenario.ahrs = read_ahrs(wearer.section("ahrs"));
  scenario.tracker = read_tracker(root.section("tracker"));
  return scenario;
}

}  // namespace cosight::sim
