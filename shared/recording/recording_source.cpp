#include "shared/recording/recording_source.hpp"

#include <algorithm>
#include <array>
#include <string_view>
#include <type_traits>
#include <utility>

#include "shared/transport/codec.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::recording {
namespace {

using Content = decltype(RecordedEvent::content);
namespace topics = transport::topics;

/// How a topic's messages are read.
struct Input {
  const transport::TopicProfile* profile;
  Agent from;
  bool (*decode)(const Message&, const transport::TopicProfile&, Content&);
};

template <class Kind>
bool decode_as(const Message& message, const transport::TopicProfile& profile, Content& content) {
  Kind sample;
  if (transport::decode(message.payload, profile, sample) != transport::Fault::kNone) return false;
  if constexpr (std::is_same_v<Kind, ImageSample>) sample.sequence = message.sequence;
  if constexpr (std::is_constructible_v<Sample, Kind>) {
    content = Sample(std::move(sample));
  } else {
    content = std::move(sample);
  }
  return true;
}

template <class Kind>
constexpr Input input(const transport::Topic<Kind>& topic, Agent from) {
  return {&topic.profile, from, &decode_as<Kind>};
}

std::string_view ros_name(const Input& input) {
  return input.profile->name.substr(2);  // without "rt"
}

const Input* input_of(const Channel& channel) {
  using enum Agent;
  static constexpr std::array kInputs = {
      input(topics::kRobotImageCompressed, kRobot),     input(topics::kRobotImage, kRobot),
      input(topics::kRobotCameraInfo, kRobot),          input(topics::kRobotLaserFront, kRobot),
      input(topics::kRobotLaserRear, kRobot),           input(topics::kRobotImu, kRobot),
      input(topics::kRobotWheelOdometry, kRobot),       input(topics::kRobotWearerPose, kRobot),
      input(topics::kWearableImageCompressed, kWearer), input(topics::kWearableImage, kWearer),
      input(topics::kWearableCameraInfo, kWearer),      input(topics::kWearableImu, kWearer),
      input(topics::kWearableHeartbeat, kWearer)};
  const auto found = std::find_if(kInputs.begin(), kInputs.end(),
                                  [&](const Input& input) { return ros_name(input) == channel.topic; });
  return found == kInputs.end() ? nullptr : &*found;
}

MessageFilter inputs_only() {
  MessageFilter filter;
  filter.wants = [](const Channel& channel) { return input_of(channel) != nullptr; };
  return filter;
}

}  // namespace

RecordingSource::RecordingSource(const McapReader& reader)
    : reader_(reader), cursor_(reader.messages(inputs_only(), MessageOrder::kFile)) {}

std::optional<RecordedEvent> RecordingSource::next() {
  while (const auto message = cursor_.next()) {
    const Input& input = *input_of(reader_.contents().channels.at(message->channel_id));
    RecordedEvent event{message->log_time, input.from, {}};
    if (input.decode(*message, *input.profile, event.content)) {
      ++delivered_;
      return event;
    }
    ++invalid_;
  }
  return std::nullopt;
}

std::optional<CameraModel> recorded_robot_camera(const McapReader& reader) {
  MessageFilter filter;
  filter.wants = [](const Channel& channel) {
    const Input* input = input_of(channel);
    return input != nullptr && input->profile == &topics::kRobotCameraInfo.profile;
  };
  MessageCursor cursor = reader.messages(filter, MessageOrder::kFile);
  while (const auto message = cursor.next()) {
    CameraInfoSample info;
    if (transport::decode(message->payload, topics::kRobotCameraInfo.profile, info) ==
        transport::Fault::kNone)
      return info.camera;
  }
  return std::nullopt;
}

}  // namespace cosight::recording
