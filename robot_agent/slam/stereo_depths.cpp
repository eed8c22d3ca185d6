#include "robot_agent/slam/stereo_depths.hpp"

#include <algorithm>
#include <cmath>
#include <optional>

#include "robot_agent/ekf/triangulation.hpp"

namespace cosight::slam {
namespace {

bool is_fused(ekf::LandmarkId landmark, const ekf::UpdateReport& report) {
  return std::ranges::any_of(report.measurements, [&](const ekf::MeasurementReport& measurement) {
    return measurement.landmark == landmark && measurement.kind != ekf::MeasurementKind::kPixel &&
           measurement.outcome == ekf::Outcome::kFused;
  });
}

std::optional<StereoDepth> depth_of(const ekf::StereoMatch& match, const ekf::StereoRig& rig) {
  const auto point = ekf::triangulate(match, rig.camera_S, rig.camera_F, rig.T_SF.T);
  if (!point) return std::nullopt;
  const auto& J_pixels = point->rho_pixels;
  const Eigen::Matrix<double, 1, 6> J_pose = point->rho_pose * ekf::position_quaternion_jacobian(rig.T_SF.T);
  StereoDepth depth;
  depth.pixel_S = match.pixel_S;
  depth.inverse_distance = point->rho;
  depth.sigma = std::hypot(J_pixels.head<2>().norm() * rig.sigma_pixel_S,
                           J_pixels.tail<2>().norm() * rig.sigma_pixel_F);
  depth.shared_sigma = std::sqrt((J_pose * rig.T_SF.covariance * J_pose.transpose()).value());
  return depth;
}

}  // namespace

std::vector<StereoDepth> fused_depths(const ekf::StereoRig& rig, const std::vector<Sighting>& sightings,
                                      const PseudoStereo::Matches& matches, const ekf::UpdateReport& report) {
  std::vector<StereoDepth> depths;
  for (std::size_t i = 0; i < matches.size(); ++i) {
    if (!matches[i] || !is_fused(sightings[i].landmark, report)) continue;
    if (const auto depth = depth_of(*matches[i], rig)) depths.push_back(*depth);
  }
  return depths;
}

}  // namespace cosight::slam
