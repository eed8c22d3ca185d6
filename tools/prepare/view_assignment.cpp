#include "tools/prepare/view_assignment.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <tuple>

namespace cosight {
namespace {

constexpr double kMetresPerRadian = 2.0 / (std::numbers::pi / 2.0);

struct Candidate {
  double distance = 0.0;
  std::size_t view = 0;
  std::size_t frame = 0;
};

double axis_angle(const Pose& T_WA, const Pose& T_WB) {
  const Eigen::Vector3d axis_A = T_WA.q * Eigen::Vector3d::UnitZ();
  const Eigen::Vector3d axis_B = T_WB.q * Eigen::Vector3d::UnitZ();
  return std::atan2(axis_A.cross(axis_B).norm(), axis_A.dot(axis_B));
}

}  // namespace

double pose_distance(const Pose& T_WA, const Pose& T_WB) {
  return (T_WA.p - T_WB.p).norm() + kMetresPerRadian * T_WA.q.angularDistance(T_WB.q);
}

std::vector<OfferedView> assign_views(const std::vector<Pose>& T_WF_views,
                                      const std::vector<Pose>& T_WS_frames) {
  std::vector<Candidate> candidates;
  for (std::size_t view = 0; view < T_WF_views.size(); ++view) {
    for (std::size_t frame = 0; frame < T_WS_frames.size(); ++frame) {
      candidates.push_back({pose_distance(T_WF_views[view], T_WS_frames[frame]), view, frame});
    }
  }
  std::sort(candidates.begin(), candidates.end(), [](const Candidate& a, const Candidate& b) {
    return std::tie(a.distance, a.view, a.frame) < std::tie(b.distance, b.view, b.frame);
  });
  std::vector<bool> view_taken(T_WF_views.size(), false);
  std::vector<bool> frame_taken(T_WS_frames.size(), false);
  std::vector<OfferedView> offers;
  for (const auto& [distance, view, frame] : candidates) {
    if (view_taken[view] || frame_taken[frame]) continue;
    view_taken[view] = true;
    frame_taken[frame] = true;
    offers.push_back({view, frame, (T_WF_views[view].p - T_WS_frames[frame].p).norm(),
                      axis_angle(T_WF_views[view], T_WS_frames[frame])});
  }
  std::sort(offers.begin(), offers.end(), [](const auto& a, const auto& b) { return a.frame < b.frame; });
  return offers;
}

}  // namespace cosight
