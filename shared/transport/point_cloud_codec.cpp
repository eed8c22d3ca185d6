#include <sensor_msgs.h>

#include <array>
#include <cmath>
#include <cstring>
#include <optional>
#include <string>
#include <string_view>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {

namespace {

using sensor_msgs::msg::PointCloud2;
using sensor_msgs::msg::PointField;

constexpr std::uint32_t kMostFields = 64;

struct Channel {
  std::string_view name;
  float CloudPoint::*value;
};

// Each a float32, one after another; x, y, z must be in a cloud from elsewhere, the others may.
constexpr std::array kChannels = {Channel{"x", &CloudPoint::x}, Channel{"y", &CloudPoint::y},
                                  Channel{"z", &CloudPoint::z}, Channel{"intensity", &CloudPoint::intensity},
                                  Channel{"sigma", &CloudPoint::sigma}};
constexpr std::size_t kNeeded = 3;
constexpr std::uint32_t kStep = kChannels.size() * sizeof(float);
static_assert(sizeof(CloudPoint) == kStep);

using Offsets = std::array<std::optional<std::uint32_t>, kChannels.size()>;

std::vector<PointField> fields() {
  std::vector<PointField> fields(kChannels.size());
  for (std::size_t i = 0; i < fields.size(); ++i) {
    fields[i].name(std::string(kChannels[i].name));
    fields[i].offset(static_cast<std::uint32_t>(i * sizeof(float)));
    fields[i].datatype(sensor_msgs::msg::PointField_Constants::FLOAT32);
    fields[i].count(1);
  }
  return fields;
}

// A field takes more memory than its bytes on the wire: a payload of lying field counts may not take 50 x its
// size.
Fault check_number_of_fields(std::span<const std::uint8_t> payload, const TopicProfile& topic) {
  std_msgs::msg::Header header;
  std::uint32_t height = 0;
  std::uint32_t width = 0;
  std::uint32_t count = 0;
  const Fault fault = read_body(payload, topic.max_bytes, [&](eprosima::fastcdr::Cdr& cdr) {
    header.deserialize(cdr);
    cdr >> height >> width >> count;
  });
  return first_of(fault, count > kMostFields ? Fault::kDimensions : Fault::kNone);
}

bool is_finite(const CloudPoint& point) {
  return std::isfinite(point.x) && std::isfinite(point.y) && std::isfinite(point.z) &&
         std::isfinite(point.intensity) && std::isfinite(point.sigma);
}

Fault find_offsets(const PointCloud2& message, Offsets& offsets) {
  for (const PointField& field : message.fields()) {
    for (std::size_t i = 0; i < kChannels.size(); ++i) {
      if (field.name() != kChannels[i].name) continue;
      if (field.datatype() != sensor_msgs::msg::PointField_Constants::FLOAT32 || field.count() > 1) {
        return Fault::kEncoding;
      }
      if (std::uint64_t{field.offset()} + sizeof(float) > message.point_step()) return Fault::kSize;
      offsets[i] = field.offset();
    }
  }
  for (std::size_t i = 0; i < kNeeded; ++i) {
    if (!offsets[i]) return Fault::kEncoding;
  }
  return Fault::kNone;
}

CloudPoint read_point(const std::uint8_t* bytes, const Offsets& offsets) {
  CloudPoint point;
  for (std::size_t i = 0; i < kChannels.size(); ++i) {
    if (offsets[i]) std::memcpy(&(point.*kChannels[i].value), bytes + *offsets[i], sizeof(float));
  }
  return point;
}

// Row by row, each perhaps padded. A cloud that isn't dense marks missing points by NaN: they are left out.
Fault read_points(const PointCloud2& message, const Offsets& offsets, std::vector<CloudPoint>& points) {
  points.clear();
  for (std::size_t row = 0; row < message.height(); ++row) {
    for (std::size_t column = 0; column < message.width(); ++column) {
      const std::size_t offset = row * message.row_step() + column * message.point_step();
      const CloudPoint point = read_point(message.data().data() + offset, offsets);
      if (is_finite(point)) {
        points.push_back(point);
      } else if (message.is_dense()) {
        return Fault::kNotFinite;
      }
    }
  }
  return Fault::kNone;
}

}  // namespace

Fault encode(const PointCloudSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (sample.points.size() * kStep > topic.max_bytes) return Fault::kTooLarge;
  for (const CloudPoint& point : sample.points) {
    if (!is_finite(point)) return Fault::kNotFinite;
  }
  PointCloud2 message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  message.height(1);
  message.width(static_cast<std::uint32_t>(sample.points.size()));
  message.fields(fields());
  message.is_bigendian(false);
  message.point_step(kStep);
  message.row_step(kStep * message.width());
  message.data().resize(message.row_step());
  if (!sample.points.empty()) std::memcpy(message.data().data(), sample.points.data(), message.data().size());
  message.is_dense(true);
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, PointCloudSample& sample) {
  if (const Fault fault = check_number_of_fields(payload, topic); fault != Fault::kNone) return fault;
  PointCloud2 message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.is_bigendian()) return Fault::kEncoding;
  if (message.data().empty()) {  // whatever the rest says
    sample.points.clear();
    return Fault::kNone;
  }
  Offsets offsets;
  if (const Fault fault = find_offsets(message, offsets); fault != Fault::kNone) return fault;
  if (std::uint64_t{message.row_step()} * message.height() != message.data().size() ||
      std::uint64_t{message.point_step()} * message.width() > message.row_step()) {
    return Fault::kSize;
  }
  return read_points(message, offsets, sample.points);
}

}  // namespace cosight::transport
