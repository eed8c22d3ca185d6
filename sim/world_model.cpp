#include "sim/world_model.hpp"

#include <utility>

namespace cosight::sim {
namespace {

void add(std::vector<Quad>& quads, const PersonFigure& figure, const WearerMotion& motion, double time) {
  figure.add_to(quads, {motion.feet(time), motion.head(time), motion.gait(time), motion.liveliness(time)});
}

}  // namespace

World::World(const Scenario& scenario, std::uint64_t seed)
    : scenario_(scenario),
      scene_(build_scene(scenario.plan, seed)),
      person_(scene_, seed, 0),
      robot_figure_(scene_, seed),
      robot_(scenario.path, scenario.shaking, seed),
      wearer_(scenario.wearer, robot_.path(), seed) {
  for (std::size_t k = 0; k < scenario.passers_by.size(); ++k) {
    passers_by_.push_back(
        std::make_unique<PasserBy>(PersonFigure(scene_, seed, k + 1), scenario.passers_by[k], seed + k + 1));
  }
}

World::PasserBy::PasserBy(PersonFigure dressed, const PathPlan& plan, std::uint64_t seed)
    : figure(std::move(dressed)), path(plan), motion(WearerPlan{}, path, seed) {}

void World::set_wearer(const WearerPlan& plan) {
  wearer_.set_plan(plan);
}

void World::add_passers_by(std::vector<Quad>& quads, double time) const {
  for (const auto& person : passers_by_)
    add(quads, person->figure, person->motion, time);
}

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
  add(quads, person_, wearer_, time);
  add_passers_by(quads, time);
  return quads;
}

std::vector<Quad> World::before_wearer(double time) const {
  std::vector<Quad> quads = scene_.quads;
  robot_figure_.add_to(quads, robot_.at(time));
  add_passers_by(quads, time);
  return quads;
}

}  // namespace cosight::sim
