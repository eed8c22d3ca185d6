#include "shared/recording/sample_recorder.hpp"

#include <string>

#include "shared/recording/recorded_topic.hpp"
#include "shared/transport/codec.hpp"

namespace cosight::recording {
namespace {

namespace profiles = transport::profiles;

const transport::TopicProfile& image_profile(Agent agent, ImageEncoding encoding) {
  const bool is_raw = encoding == ImageEncoding::kMono8;
  if (agent == Agent::kRobot) return is_raw ? profiles::kRobotImage : profiles::kRobotImageCompressed;
  return is_raw ? profiles::kWearableImage : profiles::kWearableImageCompressed;
}

}  // namespace

ChannelId SampleRecorder::channel_of(const transport::TopicProfile& profile) {
  const auto known = outputs_.find(profile.name);
  if (known != outputs_.end()) return known->second.channel;
  const RecordedTopic topic = describe(
      {std::string(profile.name), std::string(transport::type_name(profile.kind)), false, {}}, schemas_);
  const SchemaId schema = writer_.add_schema(topic.schema.name, topic.schema.encoding, topic.schema.text);
  const ChannelId channel = writer_.add_channel(topic.channel.topic, topic.channel.message_encoding, schema,
                                                topic.channel.metadata);
  outputs_[profile.name].channel = channel;
  return channel;
}

template <class Kind>
bool SampleRecorder::write_to(const transport::TopicProfile& profile, const Kind& sample) {
  if (transport::encode(sample, profile, payload_) != transport::Fault::kNone) return false;
  const ChannelId channel = channel_of(profile);
  const std::uint32_t sequence = ++outputs_[profile.name].sequence;
  writer_.write(Message{channel, sequence, sample.stamp, sample.stamp, payload_});
  return true;
}

bool SampleRecorder::write(Agent agent, const Sample& sample) {
  if (const auto* const image = std::get_if<ImageSample>(&sample))
    return write_to(image_profile(agent, image->encoding), *image);
  if (const auto* const ahrs = std::get_if<AhrsSample>(&sample))
    return write_to(profiles::kWearableImu, *ahrs);
  if (const auto* const pose = std::get_if<WearerPoseSample>(&sample))
    return write_to(profiles::kRobotWearerPose, *pose);
  if (const auto* const imu = std::get_if<ImuSample>(&sample)) return write_to(profiles::kRobotImu, *imu);
  if (const auto* const odometry = std::get_if<WheelOdometrySample>(&sample))
    return write_to(profiles::kRobotWheelOdometry, *odometry);
  const auto& scan = std::get<LaserScanSample>(sample);
  const bool is_front = scan.laser == transport::frames::kLaserFront;
  return write_to(is_front ? profiles::kRobotLaserFront : profiles::kRobotLaserRear, scan);
}

bool SampleRecorder::write(Agent agent, const CameraModel& camera, Stamp stamp) {
  const auto& profile = agent == Agent::kRobot ? profiles::kRobotCameraInfo : profiles::kWearableCameraInfo;
  return write_to(profile, CameraInfoSample{stamp, camera});
}

}  // namespace cosight::recording
