#include "robot_agent/wearer_options.hpp"

namespace cosight::robot {
namespace {

void read_head(const ConfigNode& node, wearer::HeadOptions& head) {
  head.height = node.number("head_height_m", head.height, 0.3, 2.5);
  head.height_sigma = node.number("head_height_sigma_m", head.height_sigma, 1e-4, 1.0);
  head.sway_sigma = node.number("head_sway_sigma_m", head.sway_sigma, 1e-4, 1.0);
  head.p_HF = node.vector3("camera_on_head_m", head.p_HF, -1.0, 1.0);
  head.max_ahrs_age = node.number("max_ahrs_age_s", head.max_ahrs_age, 0.0, 10.0);
  head.max_heading_age = node.number("max_heading_age_s", head.max_heading_age, 0.0, 3600.0);
}

void read_start(const ConfigNode& node, wearer::StartOptions& start) {
  const auto place = node.numbers("start_at_m", {}, -100.0, 100.0);
  if (!place.empty() && place.size() != 2) {
    throw node.error("start_at_m",
                     "has to be [x, y] in the robot's body; leave it out for the nearest ahead");
  }
  if (!place.empty()) start.p_B = Eigen::Vector2d(place[0], place[1]);
}

void read_scene(const ConfigNode& node, wearer::SceneOptions& scene) {
  scene.max_range = node.number("max_range_m", scene.max_range, 0.5, 100.0);
  const auto& box = scene.own_body;
  const auto corners =
      node.numbers("own_body_m", {box.min().x(), box.min().y(), box.max().x(), box.max().y()}, -10.0, 10.0);
  if (corners.size() != 4 || corners[0] > corners[2] || corners[1] > corners[3]) {
    throw node.error("own_body_m", "has to be [x_min, y_min, x_max, y_max] in the robot's body");
  }
  scene.own_body = {Eigen::Vector2d(corners[0], corners[1]), Eigen::Vector2d(corners[2], corners[3])};
}

}  // namespace

WearerSection read_wearer_section(const ConfigNode& node) {
  WearerSection section;
  section.pose_from = node.choice("pose_from", section.pose_from,
                                  {{"auto", WearerPoseFrom::kAuto},
                                   {"tracker", WearerPoseFrom::kTracker},
                                   {"laser", WearerPoseFrom::kLaser}});
  read_head(node, section.tracking.head);
  read_start(node, section.tracking.start);
  read_scene(node, section.tracking.scene);
  auto& track = section.tracking.track;
  track.acceleration = node.number("acceleration", track.acceleration, 1e-3, 100.0);
  track.lost_sigma = node.number("lost_sigma_m", track.lost_sigma, 1e-2, 10.0);
  return section;
}

wearer::WearerOptions with_mountings(wearer::WearerOptions options, const AgentInput& input) {
  if (input.lasers.empty()) {
    throw ConfigError(
        "wearer.pose_from: laser needs to know the lasers; give input.lasers, or a dataset with "
        "robot/lasers.yaml");
  }
  if (!input.T_BS) {
    throw ConfigError(
        "wearer.pose_from: laser needs to know where the camera sits; add T_BC (the camera in "
        "the robot's body, 4x4) to its calibration");
  }
  options.lasers.clear();
  for (const LaserMounting& laser : input.lasers)
    options.lasers[laser.laser] = {laser.T_BL, laser.range_sigma};
  options.head.T_BS = *input.T_BS;
  return options;
}

}  // namespace cosight::robot
