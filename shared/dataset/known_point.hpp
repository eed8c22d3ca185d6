#pragma once

#include <Eigen/Core>
#include <optional>

namespace cosight {

/// A surveyed point: the metric start without a second camera (equations section 8).
struct KnownPoint {
  Eigen::Vector3d p_W = Eigen::Vector3d::Zero();  ///< [m]
  std::optional<Eigen::Vector2d> pixel;           ///< where the first image shows it, when that is known [px]
};

}  // namespace cosight
