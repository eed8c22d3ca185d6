#pragma once

#include <Eigen/Core>
#include <vector>

#include "sim/world/scene.hpp"

namespace cv {
class Mat;
}

namespace cosight::sim {

/// How much light there is; the default is a room's.
struct Brightness {
  double ambient = 0.75;  ///< from everywhere
  double lamp = 0.55;     ///< what one lamp adds at `reach`
  double reach = 1.5;     ///< [m]; nothing beyond four times that
};

/// Lamps: brightness of a place is a bit of light from everywhere and what the lamps send.
class Lighting {
 public:
  Lighting(std::vector<Eigen::Vector3d> lamps, const Brightness& brightness);

  /// Lamps on a grid of `spacing` [m] over the rectangle from `low` to `high`, at `height`.
  Lighting(const Eigen::Vector2d& low, const Eigen::Vector2d& high, double height, double spacing);

  /// Factor on the brightness of a surface at `p` (W) that faces along `outward` (unit length); about 1.
  double at(const Eigen::Vector3d& p, const Eigen::Vector3d& outward) const;

  /// Puts the light of the whole quad into its picture, so that it costs nothing when rendered.
  void bake(const Quad& quad, cv::Mat& picture) const;

 private:
  std::vector<Eigen::Vector3d> lamps_;
  Brightness brightness_;
};

}  // namespace cosight::sim
