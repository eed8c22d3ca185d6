#include "shared/recording/parse_records.hpp"

#include <utility>

#include "shared/recording/field_reader.hpp"

namespace cosight::recording {

std::optional<Schema> parse_schema(ByteView content) {
  FieldReader fields(content);
  Schema schema;
  schema.id = fields.number<SchemaId>();
  schema.name = fields.text();
  schema.encoding = fields.text();
  schema.text = fields.text();
  return fields.good() && schema.id != 0 ? std::optional(std::move(schema)) : std::nullopt;
}

std::optional<Channel> parse_channel(ByteView content) {
  FieldReader fields(content);
  Channel channel;
  channel.id = fields.number<ChannelId>();
  channel.schema_id = fields.number<SchemaId>();
  channel.topic = fields.text();
  channel.message_encoding = fields.text();
  channel.metadata = fields.map();
  return fields.good() ? std::optional(std::move(channel)) : std::nullopt;
}

std::optional<Message> parse_message(ByteView content) {
  FieldReader fields(content);
  Message message;
  message.channel_id = fields.number<ChannelId>();
  message.sequence = fields.number<std::uint32_t>();
  message.log_time = fields.time();
  message.publish_time = fields.time();
  message.payload = fields.rest();
  return fields.good() ? std::optional(message) : std::nullopt;
}

std::optional<Metadata> parse_metadata(ByteView content) {
  FieldReader fields(content);
  Metadata metadata;
  metadata.name = fields.text();
  metadata.entries = fields.map();
  return fields.good() ? std::optional(std::move(metadata)) : std::nullopt;
}

std::optional<ChunkHead> parse_chunk_head(ByteView content) {
  FieldReader fields(content);
  ChunkHead head;
  head.start = fields.time();
  head.end = fields.time();
  head.uncompressed_size = fields.number<std::uint64_t>();
  head.crc = fields.number<std::uint32_t>();
  head.compression = fields.text();
  head.size = fields.number<std::uint64_t>();
  head.records = fields.rest();
  return fields.good() ? std::optional(std::move(head)) : std::nullopt;
}

}  // namespace cosight::recording
