#pragma once

#include <cstdint>
#include <memory>
#include <vector>

#include "sim/motion/robot_motion.hpp"
#include "sim/motion/wearer_motion.hpp"
#include "sim/scenario.hpp"
#include "sim/world/figures.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// The building and the two who walk in it: what is where at any time [s since the start]. Const functions
/// may be called from several threads.
class World {
 public:
  World(const Scenario& scenario, std::uint64_t seed);

  double duration() const;

  Pose robot(double time) const { return robot_.at(time); }    ///< T_WB
  Pose head(double time) const { return wearer_.head(time); }  ///< T_WH
  Pose robot_camera(double time) const;                        ///< T_WS
  Pose wearer_camera(double time) const;                       ///< T_WF

  /// Other ways of the wearer, before anything is asked.
  void set_wearer(const WearerPlan& plan);

  /// All that the robot's sensors can see: the building and the people.
  std::vector<Quad> before_robot(double time) const;
  /// All that the worn camera can see: the building, the robot, other people.
  std::vector<Quad> before_wearer(double time) const;
  const std::vector<Quad>& building() const { return scene_.quads; }

 private:
  /// Somebody else, on a path of their own.
  struct PasserBy {
    PasserBy(PersonFigure dressed, const PathPlan& plan, std::uint64_t seed);

    PersonFigure figure;
    Path path;
    WearerMotion motion;
  };

  void add_passers_by(std::vector<Quad>& quads, double time) const;

  const Scenario& scenario_;
  Scene scene_;
  PersonFigure person_;
  RobotFigure robot_figure_;
  RobotMotion robot_;
  WearerMotion wearer_;
  std::vector<std::unique_ptr<PasserBy>> passers_by_;  ///< each is pointed to by its motion
};

}  // namespace cosight::sim
