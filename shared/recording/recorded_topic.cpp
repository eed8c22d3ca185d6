#include "shared/recording/recorded_topic.hpp"

#include <algorithm>
#include <charconv>
#include <sstream>

#include "shared/recording/type_names.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::recording {
namespace {

// Keys of a channel's metadata.
constexpr const char* kTopic = "dds.topic";
constexpr const char* kType = "dds.type";
constexpr const char* kKeyed = "dds.keyed";
constexpr const char* kReliability = "dds.reliability";
constexpr const char* kDurability = "dds.durability";
constexpr const char* kLivelinessLease = "dds.liveliness_lease";
constexpr const char* kDeadline = "dds.deadline";
constexpr const char* kOwnership = "dds.ownership";
constexpr const char* kPartitions = "dds.partitions";  ///< one a line
constexpr const char* kRosQos = "offered_qos_profiles";

std::string text_of(double number) {
  std::ostringstream text;
  text << number;
  return text.str();
}

/// rmw's numbers: reliability 1 reliable, 2 best effort; durability 1 transient local, 2 volatile.
std::string ros_qos(const transport::BlindQos& qos) {
  const std::string infinite = "\n    sec: 9223372036\n    nsec: 854775807";
  return std::string("- history: 1\n  depth: 10\n  reliability: ") + (qos.reliable ? "1" : "2") +
         "\n  durability: " + (qos.transient_local ? "1" : "2") + "\n  deadline:" + infinite +
         "\n  lifespan:" + infinite + "\n  liveliness: 1\n  liveliness_lease_duration:" + infinite +
         "\n  avoid_ros_namespace_conventions: false";
}

TextMap metadata_of(const transport::BlindTopic& topic) {
  const transport::BlindQos& qos = topic.qos;
  std::string partitions;
  for (const std::string& partition : qos.partitions)
    partitions += partition + "\n";
  TextMap metadata{{kTopic, topic.name},
                   {kType, topic.type},
                   {kReliability, qos.reliable ? "reliable" : "best_effort"},
                   {kDurability, qos.transient_local ? "transient_local" : "volatile"},
                   {kRosQos, ros_qos(qos)}};
  if (topic.keyed) metadata[kKeyed] = "true";
  if (qos.exclusive) metadata[kOwnership] = "exclusive";
  if (qos.liveliness_lease > 0.0) metadata[kLivelinessLease] = text_of(qos.liveliness_lease);
  if (qos.deadline > 0.0) metadata[kDeadline] = text_of(qos.deadline);
  if (!partitions.empty()) metadata[kPartitions] = partitions;
  return metadata;
}

std::string value_of(const TextMap& metadata, const char* key) {
  const auto found = metadata.find(key);
  return found == metadata.end() ? std::string() : found->second;
}

double number_of(const TextMap& metadata, const char* key) {
  const std::string text = value_of(metadata, key);
  double number = 0.0;
  std::from_chars(text.data(), text.data() + text.size(), number);
  return std::clamp(number, 0.0, 1e9);
}

/// What a line of rosbag2's profile says, "reliability: best_effort" or "reliability: 2".
bool ros_qos_says(const TextMap& metadata, const std::string& key, const char* number, const char* word) {
  const std::string profile = value_of(metadata, kRosQos);
  const std::size_t at = profile.find(key + ": ");
  if (at == std::string::npos) return false;
  const std::string value = profile.substr(at + key.size() + 2, profile.find('\n', at) - at - key.size() - 2);
  return value == number || value == word;
}

}  // namespace

RecordedTopic describe(const transport::BlindTopic& topic, const MessageSchemas& schemas) {
  RecordedTopic recorded;
  recorded.schema.name = ros_type(topic.type);
  if (auto text = schemas.ros2msg(recorded.schema.name)) {
    recorded.schema.encoding = "ros2msg";
    recorded.schema.text = std::move(*text);
  }
  recorded.channel.topic = ros_topic(topic.name);
  recorded.channel.message_encoding = "cdr";
  recorded.channel.metadata = metadata_of(topic);
  return recorded;
}

transport::BlindTopic blind_topic(const Channel& channel, const Schema* schema) {
  const TextMap& metadata = channel.metadata;
  transport::BlindTopic topic;
  topic.name = metadata.contains(kTopic) ? metadata.at(kTopic) : dds_topic(channel.topic);
  topic.type = metadata.contains(kType) ? metadata.at(kType)
               : schema != nullptr      ? dds_type(schema->name)
                                        : std::string();
  topic.keyed = value_of(metadata, kKeyed) == "true";
  topic.qos.exclusive = value_of(metadata, kOwnership) == "exclusive";
  topic.qos.liveliness_lease = number_of(metadata, kLivelinessLease);
  topic.qos.deadline = number_of(metadata, kDeadline);
  topic.qos.reliable = metadata.contains(kReliability)
                           ? metadata.at(kReliability) == "reliable"
                           : !ros_qos_says(metadata, "reliability", "2", "best_effort");
  topic.qos.transient_local = metadata.contains(kDurability)
                                  ? metadata.at(kDurability) == "transient_local"
                                  : ros_qos_says(metadata, "durability", "1", "transient_local");
  std::istringstream partitions(value_of(metadata, kPartitions));
  for (std::string partition; std::getline(partitions, partition);)
    topic.qos.partitions.push_back(partition);
  return topic;
}

bool is_latched(const transport::BlindTopic& topic) {
  for (const auto* profile : transport::all_topics())
    if (profile->name == topic.name) return profile->latched;
  return topic.qos.transient_local;
}

}  // namespace cosight::recording
