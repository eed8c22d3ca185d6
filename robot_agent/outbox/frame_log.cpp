#include "robot_agent/outbox/frame_log.hpp"

#include <array>
#include <cmath>
#include <cstdio>

#include "shared/dataset/number_text.hpp"
#include "shared/geometry/convex_polygon.hpp"

namespace cosight::outbox {
namespace {

constexpr double kDegreesPerRadian = 180.0 / M_PI;

std::string text_of(double value) {
  if (!std::isfinite(value)) return {};
  std::array<char, 32> digits{};
  std::snprintf(digits.data(), digits.size(), "%.6g", value);
  return digits.data();
}

std::string text_of(bool value) {
  return value ? "1" : "0";
}

/// Share of an image that a polygon in it covers.
std::string area_share(const std::vector<Eigen::Vector2d>& polygon, const GrayImage* image) {
  if (image == nullptr || image->empty()) return {};
  return text_of(area(polygon) / (static_cast<double>(image->width) * image->height));
}

const GrayImage* worn_image(const FrameBundle& bundle) {
  return bundle.wearer ? bundle.wearer->image.get() : nullptr;
}

struct Column {
  const char* name;
  std::string (*text)(const FrameBundle& bundle, const FrameEstimate& estimate);
};

using B = FrameBundle;
using E = FrameEstimate;

constexpr std::array kColumns{
    Column{"stamp_ns", [](const B&, const E& e) { return std::to_string(e.stamp); }},
    Column{"sequence", [](const B&, const E& e) { return std::to_string(e.sequence); }},
    Column{"tracking", [](const B&, const E& e) { return std::string(to_string(e.tracking)); }},
    Column{"image", [](const B& b, const E&) { return text_of(b.image != nullptr); }},
    Column{"worn_image", [](const B& b, const E&) { return text_of(b.wearer.has_value()); }},
    Column{"worn_delay_ms",
           [](const B& b, const E&) {
             return b.wearer ? text_of(1e3 * to_seconds(b.wearer->stamp - b.stamp)) : std::string();
           }},

    Column{"overlap", [](const B&, const E& e) { return text_of(e.overlap.predicted); }},
    Column{"outcome", [](const B&, const E& e) { return std::string(to_string(e.pseudo_stereo_outcome)); }},
    Column{"far_depth_m", [](const B&, const E& e) { return text_of(e.overlap.far_depth); }},
    Column{"roi_share_of_S",
           [](const B& b, const E& e) { return area_share(e.overlap.roi_in_S, b.image.get()); }},
    Column{"roi_share_of_F",
           [](const B& b, const E& e) { return area_share(e.overlap.roi_in_F, worn_image(b)); }},
    Column{"described", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.described); }},
    Column{"ratio_test", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.ratio_test); }},
    Column{"epipolar", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.epipolar); }},
    Column{"too_little_parallax",
           [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.too_little_parallax); }},
    Column{"chi_squared", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.chi_squared); }},
    Column{"joint_compatibility",
           [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.joint_compatibility); }},
    Column{"fused", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.fused); }},
    Column{"initialised", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.initialised); }},
    Column{"redundant", [](const B&, const E& e) { return std::to_string(e.pseudo_stereo.redundant); }},

    Column{"predicted_in_view",
           [](const B&, const E& e) { return std::to_string(e.search.predicted_in_view); }},
    Column{"searched", [](const B&, const E& e) { return std::to_string(e.search.searched); }},
    Column{"not_found", [](const B&, const E& e) { return std::to_string(e.search.not_found); }},
    Column{"search_chi_squared", [](const B&, const E& e) { return std::to_string(e.search.chi_squared); }},
    Column{"search_joint_compatibility",
           [](const B&, const E& e) { return std::to_string(e.search.joint_compatibility); }},
    Column{"fused_pixels", [](const B&, const E& e) { return std::to_string(e.search.fused_pixels); }},

    Column{"landmarks", [](const B&, const E& e) { return std::to_string(e.landmarks); }},
    Column{"candidates", [](const B&, const E& e) { return std::to_string(e.candidates); }},
    Column{"landmarks_added", [](const B&, const E& e) { return std::to_string(e.landmarks_added); }},
    Column{"landmarks_removed", [](const B&, const E& e) { return std::to_string(e.landmarks_removed); }},
    Column{"innovation_rms_px", [](const B&, const E& e) { return text_of(e.innovation_rms_px); }},
    Column{"nis_per_dof", [](const B&, const E& e) { return text_of(e.nis_per_dof); }},
    Column{"test_ratio", [](const B&, const E& e) { return text_of(e.test_ratio); }},
    Column{"resets", [](const B&, const E& e) { return std::to_string(e.resets); }},
    Column{"position_sigma_m", [](const B&, const E& e) { return text_of(position_sigma(e.T_WS)); }},
    Column{"orientation_sigma_deg",
           [](const B&, const E& e) { return text_of(kDegreesPerRadian * orientation_sigma(e.T_WS)); }},
    Column{"yaw_offset_deg", [](const B&, const E& e) { return text_of(kDegreesPerRadian * e.yaw_offset); }},
    Column{"yaw_offset_sigma_deg",
           [](const B&, const E& e) { return text_of(kDegreesPerRadian * e.yaw_offset_sigma); }},
    Column{"speed_m_per_s", [](const B&, const E& e) { return text_of(e.v_W.norm()); }},
    Column{"turn_rate_deg_per_s",
           [](const B&, const E& e) { return text_of(kDegreesPerRadian * e.omega_S.norm()); }},

    Column{"decode_ms", [](const B& b, const E&) { return text_of(b.decode_ms); }},
    Column{"predict_ms", [](const B&, const E& e) { return text_of(e.timings.predict); }},
    Column{"search_ms", [](const B&, const E& e) { return text_of(e.timings.search); }},
    Column{"overlap_ms", [](const B&, const E& e) { return text_of(e.timings.overlap); }},
    Column{"pseudo_stereo_ms", [](const B&, const E& e) { return text_of(e.timings.pseudo_stereo); }},
    Column{"validate_ms", [](const B&, const E& e) { return text_of(e.timings.validate); }},
    Column{"update_ms", [](const B&, const E& e) { return text_of(e.timings.update); }},
    Column{"map_ms", [](const B&, const E& e) { return text_of(e.timings.map); }},
    Column{"total_ms", [](const B& b, const E& e) { return text_of(frame_ms(b, e)); }},
};

}  // namespace

std::string frame_log_header() {
  std::string header;
  for (const Column& column : kColumns) {
    if (!header.empty()) header += ',';
    header += column.name;
  }
  return header;
}

std::string frame_log_row(const FrameBundle& bundle, const FrameEstimate& estimate) {
  std::string row;
  for (const Column& column : kColumns) {
    if (!row.empty()) row += ',';
    row += column.text(bundle, estimate);
  }
  return row;
}

std::string trajectory_line(Stamp stamp, const Pose& T_WS) {
  const Eigen::Vector3d& p = T_WS.p;
  const Eigen::Quaterniond& q = T_WS.q;
  std::array<char, 256> pose{};
  std::snprintf(pose.data(), pose.size(), " %.9g %.9g %.9g %.9g %.9g %.9g %.9g", p.x(), p.y(), p.z(), q.x(),
                q.y(), q.z(), q.w());
  return seconds_text(stamp) + pose.data();
}

double frame_ms(const FrameBundle& bundle, const FrameEstimate& estimate) {
  const bool decoding_is_in = estimate.timings.decode > 0.0;
  return estimate.timings.total + (decoding_is_in ? 0.0 : bundle.decode_ms);
}

double position_sigma(const UncertainPose& pose) {
  return std::sqrt(pose.covariance.diagonal().head<3>().sum());
}

double orientation_sigma(const UncertainPose& pose) {
  return std::sqrt(pose.covariance.diagonal().tail<3>().sum());
}

}  // namespace cosight::outbox
