#pragma once

#include <cstdint>
#include <vector>

#include "shared/geometry/pose.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// How a person stands at one moment.
struct Posture {
  Pose T_WP;            ///< the point on the floor under the body, x where it walks
  Pose T_WH;            ///< the head: between the ears, x where the face points
  double gait = 0.0;    ///< [rad], two steps a turn
  double stride = 0.0;  ///< 0 stands, 1 walks
};

/// The clothes and the body of a person, of upright prisms and boxes: legs that swing, trunk, arms, head.
class PersonFigure {
 public:
  PersonFigure(Scene& scene, std::uint64_t seed, std::uint64_t person);

  /// The body in W, added to `quads`.
  void add_to(std::vector<Quad>& quads, const Posture& posture) const;

 private:
  Quad trousers_, shirt_, skin_;
};

/// The robot: a low box with a mast.
class RobotFigure {
 public:
  RobotFigure(Scene& scene, std::uint64_t seed);

  void add_to(std::vector<Quad>& quads, const Pose& T_WB) const;

 private:
  Quad cover_;
};

}  // namespace cosight::sim
