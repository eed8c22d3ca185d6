#include <diagnostic_msgs.h>

#include <cstdint>

#include "shared/transport/cdr.hpp"
#include "shared/transport/message_parts.hpp"

namespace cosight::transport {
namespace {

constexpr std::size_t kMostValues = 64;

Fault check(const DiagnosticSample& sample) {
  if (sample.values.size() > kMostValues || sample.level > DiagnosticLevel::kStale) return Fault::kDimensions;
  Fault fault = first_of(check_text(sample.name), check_text(sample.message));
  for (const auto& [key, value] : sample.values)
    fault = first_of(fault, check_text(key), check_text(value));
  return fault;
}

}  // namespace

Fault encode(const DiagnosticSample& sample, const TopicProfile& topic, std::vector<std::uint8_t>& payload) {
  if (const Fault fault = check(sample); fault != Fault::kNone) return fault;
  diagnostic_msgs::msg::DiagnosticArray message;
  if (const Fault fault = to_header(sample.stamp, topic.frame_id, message.header()); fault != Fault::kNone) {
    return fault;
  }
  diagnostic_msgs::msg::DiagnosticStatus& status = message.status().emplace_back();
  status.level(static_cast<std::uint8_t>(sample.level));
  status.name(sample.name);
  status.message(sample.message);
  for (const auto& [key, value] : sample.values) {
    diagnostic_msgs::msg::KeyValue& pair = status.values().emplace_back();
    pair.key(key);
    pair.value(value);
  }
  return serialize(message, topic.max_bytes, payload);
}

Fault decode(std::span<const std::uint8_t> payload, const TopicProfile& topic, DiagnosticSample& sample) {
  diagnostic_msgs::msg::DiagnosticArray message;
  if (const Fault fault = deserialize(payload, topic.max_bytes, message); fault != Fault::kNone) return fault;
  if (const Fault fault = from_header(message.header(), sample.stamp); fault != Fault::kNone) return fault;
  if (message.status().size() != 1) return Fault::kDimensions;
  const diagnostic_msgs::msg::DiagnosticStatus& status = message.status().front();
  sample.level = static_cast<DiagnosticLevel>(status.level());
  sample.name = status.name();
  sample.message = status.message();
  sample.values.clear();
  for (const diagnostic_msgs::msg::KeyValue& pair : status.values())
    sample.values.emplace_back(pair.key(), pair.value());
  return check(sample);
}

}  // namespace cosight::transport
