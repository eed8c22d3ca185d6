#pragma once

#include <span>

#include "shared/dataset/stamp.hpp"
#include "shared/geometry/pose.hpp"
#include "sim/render/camera.hpp"
#include "sim/world/scene.hpp"

namespace cosight::sim {

/// How much the cameras see of each other's places at one frame.
struct OverlapTruth {
  Stamp stamp = 0;
  double share_of_S = 0.0;  ///< of Cs' picture that Cf sees as well, 0 … 1
  double share_of_F = 0.0;
};

/// Share of camera A's picture (0 … 1, on a grid of rays) that shows places which camera B sees as well, with
/// nothing of the building between them.
double seen_by_both(std::span<const Quad> building, const Camera& A, const Pose& T_WA, const Camera& B,
                    const Pose& T_WB);

}  // namespace cosight::sim
