#include "shared/transport/topics.hpp"

#include <array>

namespace cosight::transport {

namespace {

// A frame of 4096 x 4096 gray pixels and a header: nothing larger is read.
constexpr std::size_t kLargestFrame = std::size_t{17} << 20;
constexpr std::size_t kLargestMap = std::size_t{32} << 20;

// One second of frames at 30 Hz and of AHRS at 200 Hz is repaired after an outage. With five samples, as is
// usual, 2 to 4 % are pushed out of the history before they are repaired at 5 % loss.
constexpr int kFrameDepth = 30;
constexpr int kAhrsDepth = 200;
constexpr int kScanDepth = 50;
constexpr int kReportDepth = 30;
constexpr int kLatest = 1;
// A writer that is late sends the newest only: with one kept, one in a hundred heartbeats was lost on a busy
// machine.
constexpr int kHeartbeatDepth = 10;

// A killed peer is noticed in half a second instead of Fast DDS's 20 s.
constexpr double kHeartbeatLease = 0.5;

}  // namespace

namespace profiles {

const TopicProfile kWearableImageCompressed{.name = "rt/cosight/wearable/image/compressed",
                                            .kind = MessageKind::kCompressedImage,
                                            .frame_id = frames::kWearerCamera,
                                            .depth = kFrameDepth,
                                            .paced = true,
                                            .max_bytes = kLargestFrame};
const TopicProfile kWearableImage{.name = "rt/cosight/wearable/image",
                                  .kind = MessageKind::kImage,
                                  .frame_id = frames::kWearerCamera,
                                  .depth = kFrameDepth,
                                  .paced = true,
                                  .max_bytes = kLargestFrame};
const TopicProfile kWearableCameraInfo{.name = "rt/cosight/wearable/camera_info",
                                       .kind = MessageKind::kCameraInfo,
                                       .frame_id = frames::kWearerCamera,
                                       .depth = kLatest,
                                       .latched = true};
const TopicProfile kWearableImu{.name = "rt/cosight/wearable/imu",
                                .kind = MessageKind::kImu,
                                .frame_id = frames::kWearerHead,
                                .depth = kAhrsDepth};
const TopicProfile kWearableHeartbeat{.name = "rt/cosight/wearable/heartbeat",
                                      .kind = MessageKind::kHeartbeat,
                                      .frame_id = frames::kWearerHead,
                                      .depth = kHeartbeatDepth,
                                      .liveliness_lease = kHeartbeatLease};
const TopicProfile kRobotImageCompressed{.name = "rt/cosight/robot/image/compressed",
                                         .kind = MessageKind::kCompressedImage,
                                         .frame_id = frames::kRobotCamera,
                                         .depth = kFrameDepth,
                                         .paced = true,
                                         .max_bytes = kLargestFrame};
const TopicProfile kRobotImage{.name = "rt/cosight/robot/image",
                               .kind = MessageKind::kImage,
                               .frame_id = frames::kRobotCamera,
                               .depth = kFrameDepth,
                               .paced = true,
                               .max_bytes = kLargestFrame};
const TopicProfile kRobotCameraInfo{.name = "rt/cosight/robot/camera_info",
                                    .kind = MessageKind::kCameraInfo,
                                    .frame_id = frames::kRobotCamera,
                                    .depth = kLatest,
                                    .latched = true};
const TopicProfile kRobotLaserFront{.name = "rt/cosight/robot/laser_front",
                                    .kind = MessageKind::kLaserScan,
                                    .frame_id = frames::kLaserFront,
                                    .depth = kScanDepth};
const TopicProfile kRobotLaserRear{.name = "rt/cosight/robot/laser_rear",
                                   .kind = MessageKind::kLaserScan,
                                   .frame_id = frames::kLaserRear,
                                   .depth = kScanDepth};
const TopicProfile kRobotImu{.name = "rt/cosight/robot/imu",
                             .kind = MessageKind::kImu,
                             .frame_id = frames::kRobotImu,
                             .depth = kAhrsDepth};
const TopicProfile kRobotWheelOdometry{.name = "rt/cosight/robot/wheel_odometry",
                                       .kind = MessageKind::kOdometry,
                                       .frame_id = frames::kWheelOdometry,
                                       .depth = kScanDepth};
const TopicProfile kRobotWearerPose{.name = "rt/cosight/robot/wearer_pose",
                                    .kind = MessageKind::kPoseWithCovarianceStamped,
                                    .frame_id = frames::kRobotCamera,
                                    .depth = kAhrsDepth};
const TopicProfile kRobotOdometry{.name = "rt/cosight/robot/odometry",
                                  .kind = MessageKind::kOdometry,
                                  .frame_id = frames::kWorld,
                                  .depth = kReportDepth};
const TopicProfile kRobotVinsOdometry{.name = "rt/cosight/robot/vins/odometry",
                                      .kind = MessageKind::kOdometry,
                                      .frame_id = frames::kVinsWorld,
                                      .depth = kReportDepth};
const TopicProfile kRobotMap{.name = "rt/cosight/robot/map",
                             .kind = MessageKind::kPointCloud2,
                             .frame_id = frames::kWorld,
                             .depth = kLatest,
                             .latched = true,
                             .paced = true,
                             .max_bytes = kLargestMap};
const TopicProfile kRobotOverlap{.name = "rt/cosight/robot/overlap",
                                 .kind = MessageKind::kOverlapReport,
                                 .frame_id = frames::kRobotCamera,
                                 .depth = kReportDepth};
const TopicProfile kRobotDiagnostics{.name = "rt/cosight/robot/diagnostics",
                                     .kind = MessageKind::kDiagnosticArray,
                                     .frame_id = frames::kRobotCamera,
                                     .depth = kReportDepth};
const TopicProfile kRobotHeartbeat{.name = "rt/cosight/robot/heartbeat",
                                   .kind = MessageKind::kHeartbeat,
                                   .frame_id = frames::kRobotCamera,
                                   .depth = kHeartbeatDepth,
                                   .liveliness_lease = kHeartbeatLease};

}  // namespace profiles

std::string_view type_name(MessageKind kind) {
  switch (kind) {
    case MessageKind::kImage:
      return "sensor_msgs::msg::dds_::Image_";
    case MessageKind::kCompressedImage:
      return "sensor_msgs::msg::dds_::CompressedImage_";
    case MessageKind::kCameraInfo:
      return "sensor_msgs::msg::dds_::CameraInfo_";
    case MessageKind::kImu:
      return "sensor_msgs::msg::dds_::Imu_";
    case MessageKind::kLaserScan:
      return "sensor_msgs::msg::dds_::LaserScan_";
    case MessageKind::kPoseWithCovarianceStamped:
      return "geometry_msgs::msg::dds_::PoseWithCovarianceStamped_";
    case MessageKind::kOdometry:
      return "nav_msgs::msg::dds_::Odometry_";
    case MessageKind::kPointCloud2:
      return "sensor_msgs::msg::dds_::PointCloud2_";
    case MessageKind::kOverlapReport:
      return "cosight_msgs::msg::dds_::OverlapReport_";
    case MessageKind::kDiagnosticArray:
      return "diagnostic_msgs::msg::dds_::DiagnosticArray_";
    case MessageKind::kHeartbeat:
      return "cosight_msgs::msg::dds_::Heartbeat_";
  }
  return "";
}

std::span<const TopicProfile* const> all_topics() {
  static constexpr std::array kAll = {&profiles::kWearableImageCompressed,
                                      &profiles::kWearableImage,
                                      &profiles::kWearableCameraInfo,
                                      &profiles::kWearableImu,
                                      &profiles::kWearableHeartbeat,
                                      &profiles::kRobotImageCompressed,
                                      &profiles::kRobotImage,
                                      &profiles::kRobotCameraInfo,
                                      &profiles::kRobotLaserFront,
                                      &profiles::kRobotLaserRear,
                                      &profiles::kRobotImu,
                                      &profiles::kRobotWheelOdometry,
                                      &profiles::kRobotWearerPose,
                                      &profiles::kRobotOdometry,
                                      &profiles::kRobotVinsOdometry,
                                      &profiles::kRobotMap,
                                      &profiles::kRobotOverlap,
                                      &profiles::kRobotDiagnostics,
                                      &profiles::kRobotHeartbeat};
  return kAll;
}

}  // namespace cosight::transport
