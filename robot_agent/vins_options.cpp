#include "robot_agent/vins_options.hpp"

namespace cosight::robot {
namespace {

void read_noise(const ConfigNode& node, vins::ImuNoise& noise) {
  noise.accelerometer = node.number("accelerometer_noise", noise.accelerometer, 1e-6, 1.0);
  noise.gyroscope = node.number("gyroscope_noise", noise.gyroscope, 1e-7, 1.0);
  noise.accelerometer_walk = node.number("accelerometer_walk", noise.accelerometer_walk, 1e-8, 1.0);
  noise.gyroscope_walk = node.number("gyroscope_walk", noise.gyroscope_walk, 1e-9, 1.0);
}

void read_window(const ConfigNode& node, vins::WindowOptions& window) {
  using enum vins::TrustMode;
  window.size = static_cast<std::size_t>(node.integer("window", static_cast<int>(window.size), 5, 50));
  window.solver.max_iterations = node.integer("max_iterations", window.solver.max_iterations, 1, 100);
  vins::GraphOptions& graph = window.solver.graph;
  graph.gravity = node.number("gravity", graph.gravity, 1.0, 30.0);
  graph.estimate_extrinsics = node.boolean("refine_extrinsics", graph.estimate_extrinsics);
  graph.estimate_time_offset = node.boolean("estimate_time_offset", graph.estimate_time_offset);
  graph.trust.mode = node.choice("mode", graph.trust.mode,
                                 {{"vins", kFixed},
                                  {"ac_g", kGeometry},
                                  {"ac_gn", kTracking},
                                  {"ac_me", kRobust},
                                  {"ac_me_guarded", kGuarded}});
  graph.trust.pixel_noise = node.number("pixel_sigma", graph.trust.pixel_noise, 0.05, 20.0);
}

}  // namespace

vins::VinsThreadOptions read_vins_options(const ConfigNode& node) {
  vins::VinsThreadOptions o;
  read_window(node, o.vins.window);
  read_noise(node, o.vins.noise);
  o.tracker.max_features = node.integer("max_features", o.tracker.max_features, 20, 1000);
  o.tracker.min_distance = node.number("min_distance_px", o.tracker.min_distance, 1.0, 500.0);
  o.max_images =
      static_cast<std::size_t>(node.integer("max_queued_images", static_cast<int>(o.max_images), 1, 1000));
  return o;
}

}  // namespace cosight::robot
