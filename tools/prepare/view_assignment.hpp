#pragma once

#include <cstddef>
#include <vector>

#include "shared/geometry/pose.hpp"

namespace cosight {

/// A view offered to a frame, and how far apart the two cameras are.
struct OfferedView {
  std::size_t view = 0;
  std::size_t frame = 0;
  double baseline = 0.0;    ///< [m]
  double axis_angle = 0.0;  ///< between the optical axes [rad]
};

/// How far two poses are apart: metres, with a quarter turn counted as two metres.
double pose_distance(const Pose& T_WA, const Pose& T_WB);

/// Offers each view at the frame nearest in pose. A frame takes one view; where two views want the same
/// frame, the nearer one has it and the other gets the nearest frame still free. In the order of the frames.
std::vector<OfferedView> assign_views(const std::vector<Pose>& T_WF_views,
                                      const std::vector<Pose>& T_WS_frames);

}  // namespace cosight
