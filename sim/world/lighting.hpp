#pragma once

#include <Eigen/Core>
#include <opencv2/core/mat.hpp>
#include <vector>

#include "sim/world/scene.hpp"

namespace cosight::sim {

/// Lamps under the ceiling: brightness of a place is a bit of light from everywhere and what the lamps send.
class Lighting {
 public:
  /// Lamps on a grid of `spacing` [m] over the rectangle from `low` to `high`, at `height`.
  Lighting(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height, double spacing);

  /// Factor on the brightness of a surface at `p` (W) that faces along `outward` (unit length); about 1.
  double at(const Eigen::Vector3d& p, const Eigen::Vector3d& outward) const;

  /// Puts the light of the whole quad into its picture, so that it costs nothing when rendered.
  void bake(const Quad& quad, cv::Mat& picture) const;

 private:
  std::vector<Eigen::Vector3d> lamps_;
};

}  // namespace cosight::sim
