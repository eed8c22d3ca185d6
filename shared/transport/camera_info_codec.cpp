#include <sensor_msgs.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

constexpr int kLargestSide = 16384;  // [px]

/// The name of a distortion on the wire, and how many coefficients it has there. "scenelib_wide" is Cosight's
/// own.
struct WireDistortion {
  std::string_view name;
  std::size_t coefficients;
};

WireDistortion wire_distortion(Distortion distortion) {
  switch (distortion) {
    case Distortion::kEquidistant:
      return {"equidistant", 4};
    case Distortion::kScenelibWide:
      return {"scenelib_wide", 1};
    case Distortion::kNone:  // ROS has no name for it: five zeros
    case Distortion::kRadtan:
      break;
  }
  return {"plumb_bob", 5};
}

Fault check(const CameraModel& camera) {
  if (camera.width < 1 || camera.height < 1 || camera.width > kLargestSide || camera.height > kLargestSide) {
    return Fault::kDimensions;
  }
  const bool finite = std::isfinite(camera.fx) && std::isfinite(camera.fy) && std::isfinite(camera.cx) &&
                      std::isfinite(camera.cy) &&
                      std::all_of(camera.coefficients.begin(), camera.coefficients.end(),
                                  [](double k) { return std::isfinite(k); });
  if (!finite) return Fault::kNotFinite;
  return camera.fx > 0.0 && camera.fy > 0.0 ? Fault::kNone : Fault::kDimensions;
}

Fault decode_distortion(const sensor_msgs::msg::CameraInfo& message, CameraModel& camera) {
  for (const Distortion known : {Distortion::kRadtan, Distortion::kEquidistant, Distortion::kScenelibWide}) {
    const WireDistortion wire = wire_distortion(known);
    if (message.distortion_model() != wire.name) continue;
    if (message.d().size() != wire.coefficients && !message.d().empty()) return Fault::kDistortion;
    camera.coefficients = {};
    std::copy(message.d().begin(), message.d().end(), camera.coefficients.begin());
    const bool straight = std::all_of(camera.coefficients.begin(), camera.coefficients.end(),
                                      [](double k) { return k == 0.0; });
    camera.distortion = straight && known == Distortion::kRadtan ? Distortion::kNone : known;
    return Fault::kNone;
  }
  return Fault::kDistortion;
}

bool is_plain(const sensor_msgs::msg::CameraInfo& message) {
  const sensor_msgs::msg::RegionOfInterest& roi = message.roi();
  const bool whole = roi.x_offset() == 0 && roi.y_offset() == 0 &&
                     (roi.width() == 0 || roi.width() == message.width()) &&
                     (roi.height() == 0 || roi.height() == message.height());
  return whole && message.binning_x() <= 1 && message.binning_y() <= 1 && message.k()[1] == 0.0;
}

}  // namespace

Fault encode(const CameraInfoSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  const CameraModel& camera = sample.camera;
  if (const Fault fault = check(camera); fault != Fault::kNone) return fault;
  sensor_msgs::msg::CameraInfo message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.height(static_cast<std::uint32_t>(camera.height));
  message.width(static_cast<std::uint32_t>(camera.width));
  const WireDistortion wire = wire_distortion(camera.distortion);
  message.distortion_model(std::string(wire.name));
  message.d().assign(wire.coefficients, 0.0);
  if (camera.distortion != Distortion::kNone) {
    std::copy_n(camera.coefficients.begin(), wire.coefficients, message.d().begin());
  }
  message.k({camera.fx, 0, camera.cx, 0, camera.fy, camera.cy, 0, 0, 1});
  message.r({1, 0, 0, 0, 1, 0, 0, 0, 1});
  message.p({camera.fx, 0, camera.cx, 0, 0, camera.fy, camera.cy, 0, 0, 0, 1, 0});
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, CameraInfoSample& sample) {
  sensor_msgs::msg::CameraInfo message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  const auto side = [](std::uint32_t n) {
    return static_cast<int>(std::min(n, std::uint32_t{kLargestSide} + 1));
  };
  CameraModel& camera = sample.camera;
  camera.width = side(message.width());
  camera.height = side(message.height());
  camera.fx = message.k()[0];
  camera.cx = message.k()[2];
  camera.fy = message.k()[4];
  camera.cy = message.k()[5];
  if (const Fault fault = decode_distortion(message, camera); fault != Fault::kNone) return fault;
  if (const Fault fault = check(camera); fault != Fault::kNone) return fault;
  return is_plain(message) ? Fault::kNone : Fault::kUnsupportedCamera;
}

}  // namespace cosight::transport
