#include "robot_agent/outbox/conversions.hpp"

#include <array>
#include <cstdio>

#include "robot_agent/map/map_archive.hpp"
#include "robot_agent/outbox/frame_log.hpp"

namespace cosight::outbox {

OdometrySample odometry_of(const FrameEstimate& estimate) {
  const Eigen::Matrix3d R_SW = estimate.T_WS.T.q.toRotationMatrix().transpose();
  Eigen::Matrix<double, 6, 6> J = Eigen::Matrix<double, 6, 6>::Identity();
  J.topLeftCorner<3, 3>() = R_SW;
  OdometrySample sample;
  sample.stamp = estimate.stamp;
  sample.T_WS = estimate.T_WS;
  sample.v_S = R_SW * estimate.v_W;
  sample.omega_S = estimate.omega_S;
  sample.twist_covariance = J * estimate.twist_covariance * J.transpose();
  return sample;
}

OverlapSample overlap_of(const FrameEstimate& estimate) {
  const PseudoStereoCounts& counts = estimate.pseudo_stereo;
  OverlapSample sample;
  sample.stamp = estimate.stamp;
  sample.predicted = estimate.overlap.predicted;
  sample.far_depth = estimate.overlap.far_depth;
  sample.roi_in_S = estimate.overlap.roi_in_S;
  sample.roi_in_F = estimate.overlap.roi_in_F;
  sample.described = static_cast<std::uint32_t>(counts.described);
  sample.ratio_test = static_cast<std::uint32_t>(counts.ratio_test);
  sample.epipolar = static_cast<std::uint32_t>(counts.epipolar);
  sample.too_little_parallax = static_cast<std::uint32_t>(counts.too_little_parallax);
  sample.chi_squared = static_cast<std::uint32_t>(counts.chi_squared);
  sample.joint_compatibility = static_cast<std::uint32_t>(counts.joint_compatibility);
  sample.fused = static_cast<std::uint32_t>(counts.fused);
  sample.initialised = static_cast<std::uint32_t>(counts.initialised);
  sample.redundant = static_cast<std::uint32_t>(counts.redundant);
  sample.outcome = to_string(estimate.pseudo_stereo_outcome);
  return sample;
}

DiagnosticSample diagnostic_of(const FrameEstimate& estimate) {
  DiagnosticSample sample;
  sample.stamp = estimate.stamp;
  sample.level = estimate.tracking == Tracking::kTracking ? DiagnosticLevel::kOk
                 : estimate.tracking == Tracking::kLost   ? DiagnosticLevel::kError
                                                          : DiagnosticLevel::kWarning;
  sample.name = "slam";
  sample.message = to_string(estimate.tracking);
  const auto add = [&sample](const char* key, double value) {
    std::array<char, 32> text{};
    std::snprintf(text.data(), text.size(), "%.4g", value);
    sample.values.emplace_back(key, text.data());
  };
  add("innovation_ratio", estimate.nis_per_dof);
  add("test_ratio", estimate.test_ratio);
  add("landmarks", estimate.landmarks);
  add("position_sigma_m", position_sigma(estimate.T_WS));
  add("resets", estimate.resets);
  return sample;
}

PointCloudSample cloud_of(Stamp stamp, std::span<const MapPoint> points) {
  PointCloudSample sample;
  sample.stamp = stamp;
  sample.points.reserve(points.size());
  for (const MapPoint& point : points) {
    sample.points.push_back({.x = static_cast<float>(point.p_W.x()),
                             .y = static_cast<float>(point.p_W.y()),
                             .z = static_cast<float>(point.p_W.z()),
                             .intensity = static_cast<float>(point.intensity),
                             .sigma = static_cast<float>(map::worst_sigma(point))});
  }
  return sample;
}

}  // namespace cosight::outbox
