#include "tests/shared/recording/example_recording.hpp"

#include <map>
#include <memory>
#include <ostream>
#include <random>
#include <utility>

namespace cosight::recording {

void PrintTo(const OwnedMessage& message, std::ostream* out) {
  *out << message.topic << " #" << message.sequence << " at " << message.log_time << " ("
       << message.payload.size() << " bytes)";
}

std::vector<OwnedMessage> example_messages(int count, unsigned seed) {
  std::mt19937 random(seed);
  std::vector<OwnedMessage> messages;
  for (int i = 0; i < count; ++i) {
    OwnedMessage message;
    message.topic = i % 50 == 7 ? "/seldom" : i % 2 == 0 ? "/camera" : "/imu";
    message.sequence = static_cast<std::uint32_t>(i);
    message.log_time = 1'700'000'000'000'000'000 + i * 10'000'000LL;
    message.publish_time = message.log_time - 123'456;
    message.payload.resize(random() % 3000);
    const bool is_random = i % 2 == 0;
    for (std::uint8_t& byte : message.payload)
      byte = is_random ? static_cast<std::uint8_t>(random()) : static_cast<std::uint8_t>(i);
    messages.push_back(std::move(message));
  }
  return messages;
}

Bytes example_recording(const std::vector<OwnedMessage>& messages, const WriterOptions& options,
                        const std::function<void(McapWriter&, const Bytes&)>& each) {
  MemorySink sink;
  McapWriter writer(sink, options);
  writer.write(Attachment{5, 6, "robot.yaml", "application/yaml", {'a', ':', ' ', '1'}});
  writer.write(Metadata{"trial", {{"place", "corridor"}, {"wearer", "one"}}});
  std::map<std::string, ChannelId> channels;
  for (const OwnedMessage& m : messages) {
    if (!channels.contains(m.topic)) {
      const SchemaId schema = writer.add_schema("pkg/msg/Of" + m.topic.substr(1), "ros2msg", "uint8[] data");
      channels[m.topic] = writer.add_channel(m.topic, "cdr", schema, {{"dds.reliability", "reliable"}});
    }
    writer.write(Message{channels[m.topic], m.sequence, m.log_time, m.publish_time, m.payload});
    if (each) each(writer, sink.bytes());
  }
  writer.close();
  return sink.bytes();
}

McapReader reader_of(Bytes bytes, const ReaderLimits& limits) {
  return McapReader(std::make_unique<MemorySource>(std::move(bytes)), limits);
}

std::vector<OwnedMessage> messages_of(const McapReader& reader, MessageOrder order,
                                      const MessageFilter& filter) {
  std::vector<OwnedMessage> messages;
  auto cursor = reader.messages(filter, order);
  while (const auto message = cursor.next()) {
    messages.push_back({reader.contents().channels.at(message->channel_id).topic,
                        message->sequence,
                        message->log_time,
                        message->publish_time,
                        {message->payload.begin(), message->payload.end()}});
  }
  return messages;
}

}  // namespace cosight::recording
