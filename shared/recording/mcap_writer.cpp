#include "shared/recording/mcap_writer.hpp"

#include <algorithm>
#include <cassert>
#include <limits>
#include <utility>

#include "shared/recording/field_writer.hpp"
#include "shared/recording/recording_error.hpp"

namespace cosight::recording {
namespace {

constexpr const char* kLibrary = "cosight";
constexpr std::size_t kMostChannels = std::numeric_limits<ChannelId>::max();

/// The end of a file: groups of records, where each group is, the footer.
class Summary {
 public:
  explicit Summary(std::uint64_t position) : position_(position) {}

  void add(Opcode opcode, const Bytes& records) {
    if (records.empty()) return;
    FieldWriter offset(offsets_);
    offset.record(Opcode::kSummaryOffset, [&] {
      offset.number(static_cast<std::uint8_t>(opcode))
          .number(position_ + bytes_.size())
          .number(std::uint64_t{records.size()});
    });
    FieldWriter(bytes_).raw(records);
  }

  /// The checksum covers all before it, the footer's own beginning too.
  const Bytes& finish() {
    const std::uint64_t offsets_start = position_ + bytes_.size();
    FieldWriter fields(bytes_);
    fields.raw(offsets_)
        .number(static_cast<std::uint8_t>(Opcode::kFooter))
        .number(std::uint64_t{kFooterBytes - kRecordHeadBytes})
        .number(position_)
        .number(offsets_start);
    fields.number(crc32(bytes_)).raw(kMagic);
    return bytes_;
  }

 private:
  std::uint64_t position_;
  Bytes bytes_, offsets_;
};

template <class Known>
Bytes records_of(const std::vector<Known>& known) {
  Bytes records;
  for (const Known& one : known)
    records.insert(records.end(), one.record.begin(), one.record.end());
  return records;
}

}  // namespace

McapWriter::McapWriter(ByteSink& sink, WriterOptions options)
    : sink_(sink), options_(std::move(options)), compressor_(options_.compression, options_.level) {
  put({kMagic});
  Bytes header;
  FieldWriter fields(header);
  fields.record(Opcode::kHeader, [&] { fields.text(options_.profile).text(kLibrary); });
  put({header});
  chunk_.reserve(options_.chunk_bytes + options_.chunk_bytes / 4);
}

void McapWriter::put(std::initializer_list<ByteView> parts) {
  assert(!closed_);
  sink_.write(parts);
  for (const ByteView part : parts) {
    data_crc_.add(part);
    position_ += part.size();
  }
}

SchemaId McapWriter::add_schema(const std::string& name, const std::string& encoding,
                                const std::string& text) {
  if (schemas_.size() + 1 >= kMostChannels) throw RecordingError("more schemas than MCAP can number");
  const auto id = static_cast<SchemaId>(schemas_.size() + 1);
  Known& schema = schemas_.emplace_back();
  FieldWriter fields(schema.record);
  fields.record(Opcode::kSchema, [&] { fields.number(id).text(name).text(encoding).text(text); });
  return id;
}

ChannelId McapWriter::add_channel(const std::string& topic, const std::string& message_encoding,
                                  SchemaId schema, const TextMap& metadata) {
  assert(schema <= schemas_.size());
  if (channels_.size() >= kMostChannels) throw RecordingError("more channels than MCAP can number");
  const auto id = static_cast<ChannelId>(channels_.size());
  Known& channel = channels_.emplace_back();
  FieldWriter fields(channel.record);
  fields.record(Opcode::kChannel,
                [&] { fields.number(id).number(schema).text(topic).text(message_encoding).map(metadata); });
  channel_schemas_.push_back(schema);
  chunk_messages_.emplace_back();
  return id;
}

/// A channel and its schema stand before the channel's first message.
void McapWriter::announce(ChannelId channel) {
  if (channels_[channel].written) return;
  const auto write = [this](Known& known) {
    if (!known.written) chunk_.insert(chunk_.end(), known.record.begin(), known.record.end());
    known.written = true;
  };
  if (const SchemaId schema = channel_schemas_[channel]; schema > 0) write(schemas_[schema - 1U]);
  write(channels_[channel]);
}

void McapWriter::write(const Message& message) {
  assert(message.channel_id < channels_.size());
  const bool is_first = messages_ == 0;
  const bool is_first_of_chunk = chunk_.empty();
  announce(message.channel_id);
  const std::uint64_t offset = chunk_.size();
  FieldWriter fields(chunk_);
  fields.number(static_cast<std::uint8_t>(Opcode::kMessage))
      .number(std::uint64_t{kMessageHeadBytes + message.payload.size()})
      .number(message.channel_id)
      .number(message.sequence)
      .time(message.log_time)
      .time(message.publish_time)
      .raw(message.payload);
  chunk_messages_[message.channel_id].push_back({message.log_time, offset});
  chunk_start_ = is_first_of_chunk ? message.log_time : std::min(chunk_start_, message.log_time);
  chunk_end_ = is_first_of_chunk ? message.log_time : std::max(chunk_end_, message.log_time);
  start_ = is_first ? message.log_time : std::min(start_, message.log_time);
  end_ = is_first ? message.log_time : std::max(end_, message.log_time);
  ++messages_;
  ++message_counts_[message.channel_id];
  if (chunk_.size() >= options_.chunk_bytes) flush();
}

void McapWriter::flush() {
  if (chunk_.empty()) return;
  ChunkIndex chunk = write_chunk();
  write_message_indexes(chunk);
  chunk_indexes_.push_back(std::move(chunk));
  chunk_.clear();
}

McapWriter::ChunkIndex McapWriter::write_chunk() {
  ChunkIndex chunk;
  chunk.start = chunk_start_;
  chunk.end = chunk_end_;
  chunk.offset = position_;
  chunk.uncompressed = chunk_.size();
  const bool is_smaller = compressor_.compress(chunk_, scratch_);
  chunk.compression = is_smaller ? options_.compression : Compression::kNone;
  const ByteView records = is_smaller ? ByteView(scratch_) : ByteView(chunk_);
  chunk.compressed = records.size();

  const std::string_view compression = name_of(chunk.compression);
  Bytes head;
  const std::uint64_t content = 8 + 8 + 8 + 4 + 4 + compression.size() + 8 + records.size();
  FieldWriter(head)
      .number(static_cast<std::uint8_t>(Opcode::kChunk))
      .number(content)
      .time(chunk.start)
      .time(chunk.end)
      .number(chunk.uncompressed)
      .number(crc32(chunk_))
      .text(compression)
      .number(std::uint64_t{records.size()});
  put({head, records});
  chunk.length = position_ - chunk.offset;
  return chunk;
}

void McapWriter::write_message_indexes(ChunkIndex& chunk) {
  scratch_.clear();
  FieldWriter fields(scratch_);
  for (std::size_t id = 0; id < chunk_messages_.size(); ++id) {
    auto& entries = chunk_messages_[id];
    if (entries.empty()) continue;
    const auto channel = static_cast<ChannelId>(id);
    chunk.message_indexes[channel] = position_ + scratch_.size();
    fields.record(Opcode::kMessageIndex, [&] {
      fields.number(channel).sized<std::uint32_t>([&] {
        for (const IndexEntry& entry : entries)
          fields.time(entry.log_time).number(entry.offset);
      });
    });
    entries.clear();
  }
  chunk.index_length = scratch_.size();
  put({scratch_});
}

void McapWriter::write(const Attachment& attachment) {
  flush();
  Bytes head;
  FieldWriter fields(head);
  const std::uint64_t content =
      8 + 8 + 4 + attachment.name.size() + 4 + attachment.media_type.size() + 8 + attachment.data.size() + 4;
  fields.number(static_cast<std::uint8_t>(Opcode::kAttachment))
      .number(content)
      .time(attachment.log_time)
      .time(attachment.create_time)
      .text(attachment.name)
      .text(attachment.media_type)
      .number(std::uint64_t{attachment.data.size()});
  Crc32 crc;
  crc.add(ByteView(head).subspan(kRecordHeadBytes));
  crc.add(attachment.data);
  Bytes tail;
  FieldWriter(tail).number(crc.value());

  FieldWriter index(attachment_indexes_);
  index.record(Opcode::kAttachmentIndex, [&] {
    index.number(position_)
        .number(kRecordHeadBytes + content)
        .time(attachment.log_time)
        .time(attachment.create_time)
        .number(std::uint64_t{attachment.data.size()})
        .text(attachment.name)
        .text(attachment.media_type);
  });
  ++attachments_;
  put({head, attachment.data, tail});
}

void McapWriter::write(const Metadata& metadata) {
  flush();
  Bytes record;
  FieldWriter fields(record);
  fields.record(Opcode::kMetadata, [&] { fields.text(metadata.name).map(metadata.entries); });
  FieldWriter index(metadata_indexes_);
  index.record(Opcode::kMetadataIndex,
               [&] { index.number(position_).number(std::uint64_t{record.size()}).text(metadata.name); });
  ++metadata_;
  put({record});
}

Bytes McapWriter::chunk_index_records() const {
  Bytes records;
  FieldWriter fields(records);
  for (const ChunkIndex& chunk : chunk_indexes_) {
    fields.record(Opcode::kChunkIndex, [&] {
      fields.time(chunk.start).time(chunk.end).number(chunk.offset).number(chunk.length);
      fields.sized<std::uint32_t>([&] {
        for (const auto& [channel, offset] : chunk.message_indexes)
          fields.number(channel).number(offset);
      });
      fields.number(chunk.index_length).text(name_of(chunk.compression));
      fields.number(chunk.compressed).number(chunk.uncompressed);
    });
  }
  return records;
}

Bytes McapWriter::statistics_record() const {
  Bytes record;
  FieldWriter fields(record);
  fields.record(Opcode::kStatistics, [&] {
    fields.number(messages_)
        .number(static_cast<std::uint16_t>(schemas_.size()))
        .number(static_cast<std::uint32_t>(channels_.size()))
        .number(attachments_)
        .number(metadata_)
        .number(static_cast<std::uint32_t>(chunk_indexes_.size()))
        .time(start_)
        .time(end_);
    fields.sized<std::uint32_t>([&] {
      for (const auto& [channel, count] : message_counts_)
        fields.number(channel).number(count);
    });
  });
  return record;
}

void McapWriter::close() {
  flush();
  Bytes end;
  FieldWriter end_fields(end);
  end_fields.record(Opcode::kDataEnd, [&] { end_fields.number(data_crc_.value()); });
  put({end});

  Summary summary(position_);
  summary.add(Opcode::kSchema, records_of(schemas_));
  summary.add(Opcode::kChannel, records_of(channels_));
  summary.add(Opcode::kStatistics, statistics_record());
  summary.add(Opcode::kChunkIndex, chunk_index_records());
  summary.add(Opcode::kAttachmentIndex, attachment_indexes_);
  summary.add(Opcode::kMetadataIndex, metadata_indexes_);
  put({summary.finish()});
  sink_.sync();
  closed_ = true;
}

}  // namespace cosight::recording
