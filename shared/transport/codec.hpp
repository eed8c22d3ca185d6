#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "shared/transport/samples.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

/// Why a payload is not a sample. A peer may send anything: these are counted, never thrown.
enum class Fault {
  kNone,
  kTooLarge,           ///< longer than the topic allows
  kMalformed,          ///< not the CDR of the topic's type, or bytes are missing
  kStamp,              ///< nanoseconds out of [0, 1e9), or a stamp before or after what a message can say
  kNotFinite,          ///< NaN or infinity
  kRotation,           ///< no unit quaternion
  kCovariance,         ///< not symmetric and positive semidefinite
  kDimensions,         ///< width, height or number of elements out of range
  kSize,               ///< the bytes are not as many as the dimensions say
  kEncoding,           ///< an image encoding or point field that isn't known here
  kDistortion,         ///< an unknown distortion model, or coefficients that do not fit it
  kUnsupportedCamera,  ///< skew, binning or a region of interest, which a CameraModel cannot say
  kText,               ///< a string that is too long
};
const char* to_string(Fault fault);

/// The sample as XCDR1 with its 4-byte encapsulation header, ready for the wire or a recording. `payload` is
/// overwritten; its memory is reused.
Fault encode(const ImageSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const CameraInfoSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const AhrsSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const LaserScanSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const ImuSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const WheelOdometrySample& sample, const TopicProfile& topic,
             std::vector<std::uint8_t>& payload);
Fault encode(const WearerPoseSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const OdometrySample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const PointCloudSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const OverlapSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const DiagnosticSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);
Fault encode(const HeartbeatSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload);

/// The sample in a payload that came from anywhere, every value checked. Never throws; `sample` is meaningful
/// only with Fault::kNone.
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, ImageSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, CameraInfoSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, AhrsSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, LaserScanSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, ImuSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, WheelOdometrySample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, WearerPoseSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, OdometrySample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, PointCloudSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, OverlapSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, DiagnosticSample& sample);
Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, HeartbeatSample& sample);

}  // namespace cosight::transport
