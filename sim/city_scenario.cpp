#include "sim/city_scenario.hpp"

#include "sim/sensor_plans_file.hpp"

namespace cosight::sim {
namespace {

TrafficOptions read_traffic(const ConfigNode& node, TrafficOptions traffic) {
  traffic.ahead_share = node.number("ahead_share", traffic.ahead_share, 0.0, 1.0);
  traffic.neighbours_per_minute =
      node.number("neighbours_per_minute", traffic.neighbours_per_minute, 0.0, 60.0);
  traffic.oncoming_per_minute = node.number("oncoming_per_minute", traffic.oncoming_per_minute, 0.0, 60.0);
  traffic.turning_per_minute = node.number("turning_per_minute", traffic.turning_per_minute, 0.0, 60.0);
  traffic.crossing_per_corner = node.number("crossing_per_corner", traffic.crossing_per_corner, 0.0, 20.0);
  traffic.texture = 0.0;  // pictures have theirs
  return traffic;
}

CityPlan read_plan(const ConfigNode& node) {
  CityPlan plan;
  plan.night = node.boolean("night", plan.night);
  plan.lowest_house = node.number("lowest_house_m", plan.lowest_house, 6.0, 100.0);
  plan.highest_house = node.number("highest_house_m", plan.highest_house, plan.lowest_house, 200.0);
  plan.front_texel = node.number("texel_m", plan.front_texel, 0.01, 1.0);
  plan.parked_share = node.number("parked_share", plan.parked_share, 0.0, 1.0);
  plan.lamp_spacing = node.number("lamp_spacing_m", plan.lamp_spacing, 5.0, 200.0);
  return plan;
}

}  // namespace

bool is_city(const ConfigNode& root) {
  return root.has("city");
}

CityScenario read_city_scenario(const ConfigNode& root) {
  CityScenario scenario;
  scenario.name = root.text("name", scenario.name);
  const ConfigNode city = root.section("city");
  scenario.length = city.number("length_m", scenario.length, 20.0, 20'000.0);
  scenario.route.start_speed = city.number("start_speed_mps", scenario.route.start_speed, 0.0, 15.0);
  scenario.city = read_plan(city);
  scenario.traffic = read_traffic(city.section("traffic"), scenario.traffic);
  const ConfigNode robot = root.section("robot");
  scenario.camera = read_camera(robot.section("camera"), scenario.camera, {0.4, 0.1, 0.6});
  scenario.imu = read_imu(robot.section("imu"));
  return scenario;
}

}  // namespace cosight::sim
