#include "sim/world_model.hpp"

namespace cosight::sim {

World::World(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      scene_(build_scene(scenario.plan, seed)),
      person_(scene_, seed, 0),
      robot_figure_(scene_, seed),
      robot_(scenario.path, scenario.shaking, seed),
      wearer_(scenario.wearer, robot_.path(), seed) {}

double World::duration() const {
  return scenario_.duration > 0.0 ? scenario_.duration : robot_.path().duration();
}

Pose World::robot_camera(double time) const {
  return robot(time) * scenario_.robot_camera.T_BC;
}

Pose World::wearer_camera(double time) const {
  return head(time) * scenario_.wearer_camera.T_BC;
}

std::vector<Quad> World::before_robot(double time) const {
  std::vector<Quad> quads = scene_.quads;
  person_.add_to(quads,
                 {wearer_.feet(time), wearer_.head(time), wearer_.gait(time), wearer_.liveliness(time)});
  return quads;
}

std::vector<Quad> World::before_wearer(double time) const {
  std::vector<Quad> quads = scene_.quads;
  robot_figure_.add_to(quads, robot_.at(time));
  return quads;
}

}  // namespace cosight::sim
