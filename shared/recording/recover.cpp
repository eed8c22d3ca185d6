#include "shared/recording/recover.hpp"

#include <map>
#include <string>

namespace cosight::recording {
namespace {

std::map<ChannelId, ChannelId> copy_channels(const McapContents& contents, McapWriter& writer) {
  std::map<SchemaId, SchemaId> schemas{{SchemaId{0}, SchemaId{0}}};
  for (const auto& [id, schema] : contents.schemas)
    schemas[id] = writer.add_schema(schema.name, schema.encoding, schema.text);
  std::map<ChannelId, ChannelId> channels;
  for (const auto& [id, channel] : contents.channels) {
    const auto schema = schemas.find(channel.schema_id);
    channels[id] =
        writer.add_channel(channel.topic, channel.message_encoding,
                           schema == schemas.end() ? SchemaId{0} : schema->second, channel.metadata);
  }
  return channels;
}

}  // namespace

Recovered recover(const McapReader& reader, ByteSink& sink, const WriterOptions& options) {
  const McapContents& contents = reader.contents();
  WriterOptions with_profile = options;
  with_profile.profile = contents.profile;
  McapWriter writer(sink, with_profile);
  const auto channels = copy_channels(contents, writer);
  Recovered result;
  for (const AttachmentEntry& entry : contents.attachments) {
    const auto attachment = reader.attachment(entry);
    if (attachment) writer.write(*attachment);
    ++(attachment ? result.attachments : result.damaged);
  }
  for (const Metadata& metadata : contents.metadata)
    writer.write(metadata);
  MessageCursor messages = reader.messages({}, MessageOrder::kFile);
  while (auto message = messages.next()) {
    message->channel_id = channels.at(message->channel_id);
    writer.write(*message);
    ++result.messages;
  }
  writer.close();
  result.damaged += contents.damaged;
  return result;
}

}  // namespace cosight::recording
