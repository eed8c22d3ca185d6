#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <string_view>

#include "shared/transport/samples.hpp"

namespace cosight::transport {

/// The message behind a topic.
enum class MessageKind {
  kImage,
  kCompressedImage,
  kCameraInfo,
  kImu,
  kLaserScan,
  kPoseWithCovarianceStamped,
  kOdometry,
  kPointCloud2,
  kOverlapReport,
  kDiagnosticArray,
  kHeartbeat,
};

/// ROS 2's DDS name of the type, such as "sensor_msgs::msg::dds_::Image_".
std::string_view type_name(MessageKind kind);

/// Everything that is agreed about a topic. All writers are reliable and TRANSIENT_LOCAL: a reliable VOLATILE
/// writer of Fast DDS 2.9 can hang for ever when a reader leaves during a retransmission.
struct TopicProfile {
  std::string_view name;          ///< DDS name, with ROS 2's "rt/"
  MessageKind kind;               ///< what it carries
  std::string_view frame_id;      ///< of the messages' headers
  int depth = 1;                  ///< samples kept for repair: rate x the outage to survive
  bool latched = false;           ///< a late reader gets what was sent before it came
  double liveliness_lease = 0.0;  ///< a silent writer is called dead after this [s]; 0: never
  bool paced = false;             ///< passes through the participant's flow controller
  std::size_t max_bytes = 65536;  ///< a longer payload is refused unread
};

/// A topic and the sample that it carries on this side.
template <class Sample>
struct Topic {
  const TopicProfile& profile;
};

namespace frames {
inline constexpr std::string_view kWorld = "map";                   ///< W
inline constexpr std::string_view kVinsWorld = "vins";              ///< W of VINS: z up, where it started
inline constexpr std::string_view kRobotCamera = "robot_camera";    ///< S, optical
inline constexpr std::string_view kRobotBody = "base_link";         ///< B, x forward
inline constexpr std::string_view kWheelOdometry = "odom";          ///< O: B where the wheels began to count
inline constexpr std::string_view kRobotImu = "robot_imu";          ///< I
inline constexpr std::string_view kLaserFront = "laser_front";      ///< L
inline constexpr std::string_view kLaserRear = "laser_rear";        ///< L
inline constexpr std::string_view kWearerCamera = "wearer_camera";  ///< F, optical
inline constexpr std::string_view kWearerHead = "wearer_head";      ///< H, x forward
}  // namespace frames

namespace profiles {
extern const TopicProfile kWearableImageCompressed;
extern const TopicProfile kWearableImage;
extern const TopicProfile kWearableCameraInfo;
extern const TopicProfile kWearableImu;
extern const TopicProfile kWearableHeartbeat;
extern const TopicProfile kRobotImageCompressed;
extern const TopicProfile kRobotImage;
extern const TopicProfile kRobotCameraInfo;
extern const TopicProfile kRobotLaserFront;
extern const TopicProfile kRobotLaserRear;
extern const TopicProfile kRobotImu;
extern const TopicProfile kRobotWheelOdometry;
extern const TopicProfile kRobotWearerPose;
extern const TopicProfile kRobotOdometry;
extern const TopicProfile kRobotVinsOdometry;
extern const TopicProfile kRobotMap;
extern const TopicProfile kRobotOverlap;
extern const TopicProfile kRobotDiagnostics;
extern const TopicProfile kRobotHeartbeat;
}  // namespace profiles

/// The topics of a Cosight system. An image goes to the compressed topic as JPEG or PNG, to the raw one as
/// mono8.
namespace topics {
inline constexpr Topic<ImageSample> kWearableImageCompressed{profiles::kWearableImageCompressed};
inline constexpr Topic<ImageSample> kWearableImage{profiles::kWearableImage};
inline constexpr Topic<CameraInfoSample> kWearableCameraInfo{profiles::kWearableCameraInfo};
inline constexpr Topic<AhrsSample> kWearableImu{profiles::kWearableImu};
inline constexpr Topic<HeartbeatSample> kWearableHeartbeat{profiles::kWearableHeartbeat};
inline constexpr Topic<ImageSample> kRobotImageCompressed{profiles::kRobotImageCompressed};
inline constexpr Topic<ImageSample> kRobotImage{profiles::kRobotImage};
inline constexpr Topic<CameraInfoSample> kRobotCameraInfo{profiles::kRobotCameraInfo};
inline constexpr Topic<LaserScanSample> kRobotLaserFront{profiles::kRobotLaserFront};
inline constexpr Topic<LaserScanSample> kRobotLaserRear{profiles::kRobotLaserRear};
inline constexpr Topic<ImuSample> kRobotImu{profiles::kRobotImu};
inline constexpr Topic<WheelOdometrySample> kRobotWheelOdometry{profiles::kRobotWheelOdometry};
inline constexpr Topic<WearerPoseSample> kRobotWearerPose{profiles::kRobotWearerPose};
inline constexpr Topic<OdometrySample> kRobotOdometry{profiles::kRobotOdometry};
inline constexpr Topic<OdometrySample> kRobotVinsOdometry{profiles::kRobotVinsOdometry};
inline constexpr Topic<PointCloudSample> kRobotMap{profiles::kRobotMap};
inline constexpr Topic<OverlapSample> kRobotOverlap{profiles::kRobotOverlap};
inline constexpr Topic<DiagnosticSample> kRobotDiagnostics{profiles::kRobotDiagnostics};
inline constexpr Topic<HeartbeatSample> kRobotHeartbeat{profiles::kRobotHeartbeat};
}  // namespace topics

/// All of them, for tools and tests.
std::span<const TopicProfile* const> all_topics();

}  // namespace cosight::transport
