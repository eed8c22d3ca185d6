#pragma once

#include <cstdint>
#include <vector>

#include "shared/geometry/pose.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// What a car or a lorry looks like: boxes with doors, windows, lamps, a number plate, adverts.
class VehicleFigure {
 public:
  /// `size` [m] along x (ahead), y and up; above 2.5 m it is a lorry. `number`: which one of the seed's.
  VehicleFigure(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed, std::uint64_t number);

  /// In W, added to `quads`. T_WV: on the ground under its middle, x ahead. `light`: factor on its
  /// brightness; its lamps are on when `lamps_on`.
  void add_to(std::vector<Quad>& quads, const Pose& T_WV, double light, bool lamps_on) const;

 private:
  /// A box and what its sides wear: front, rear, both sides, top.
  struct Part {
    Eigen::Vector3d foot_V;
    Eigen::Vector3d size;
    Quad front, rear, side, top;
  };

  void build_car(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed, std::uint64_t number);
  void build_lorry(Scene& scene, const Eigen::Vector3d& size, std::uint64_t seed, std::uint64_t number);

  std::vector<Part> parts_;
  Quad head_lamp_, tail_lamp_;
};

}  // namespace cosight::sim
