#pragma once

#include <cstddef>
#include <cstdint>
#include <initializer_list>
#include <map>
#include <string>
#include <vector>

#include "shared/recording/byte_sink.hpp"
#include "shared/recording/compression.hpp"
#include "shared/recording/crc32.hpp"
#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

struct WriterOptions {
  std::string profile = "ros2";
  Compression compression = Compression::kZstd;
  int level = 1;  ///< of zstd; JPEG does not get smaller at any
  /// A chunk is closed when it holds this much [bytes]. Larger: fewer index entries, more to read for one
  /// message.
  std::size_t chunk_bytes = std::size_t{1} << 20;
};

/// Writes one MCAP file: chunks, each with its message index, and at the end a summary with everything a
/// reader needs to find a message without reading the rest. What has been flushed can be read even if nothing
/// comes after it. Throws what the sink throws; then only its destruction is left.
class McapWriter {
 public:
  explicit McapWriter(ByteSink& sink, WriterOptions options = {});
  McapWriter(const McapWriter&) = delete;
  McapWriter& operator=(const McapWriter&) = delete;

  SchemaId add_schema(const std::string& name, const std::string& encoding, const std::string& text);
  ChannelId add_channel(const std::string& topic, const std::string& message_encoding, SchemaId schema,
                        const TextMap& metadata = {});
  void write(const Message& message);
  void write(const Attachment& attachment);
  void write(const Metadata& metadata);

  /// Hands the unfinished chunk to the sink. How often decides what a killed process loses.
  void flush();

  /// Summary and footer; nothing can be written after it.
  void close();

  std::uint64_t bytes_written() const { return position_; }
  std::size_t bytes_waiting() const { return chunk_.size(); }
  std::uint64_t messages() const { return messages_; }

 private:
  struct IndexEntry {
    Stamp log_time;
    std::uint64_t offset;
  };
  struct Known {  ///< a schema or a channel
    Bytes record;
    bool written = false;
  };
  struct ChunkIndex {
    Stamp start = 0, end = 0;
    std::uint64_t offset = 0, length = 0, index_length = 0, compressed = 0, uncompressed = 0;
    std::map<ChannelId, std::uint64_t> message_indexes;  ///< where each lies in the file
    Compression compression = Compression::kNone;
  };

  void put(std::initializer_list<ByteView> parts);
  void announce(ChannelId channel);
  ChunkIndex write_chunk();
  void write_message_indexes(ChunkIndex& chunk);
  Bytes chunk_index_records() const;
  Bytes statistics_record() const;

  ByteSink& sink_;
  WriterOptions options_;
  Compressor compressor_;
  std::uint64_t position_ = 0;
  Crc32 data_crc_;
  bool closed_ = false;

  std::vector<Known> schemas_;             ///< id - 1
  std::vector<Known> channels_;            ///< id
  std::vector<SchemaId> channel_schemas_;  ///< id

  Bytes chunk_;  ///< records of the unfinished chunk
  Bytes scratch_;
  Stamp chunk_start_ = 0, chunk_end_ = 0;
  std::vector<std::vector<IndexEntry>> chunk_messages_;  ///< by channel

  std::vector<ChunkIndex> chunk_indexes_;
  Bytes attachment_indexes_, metadata_indexes_;  ///< records of the summary
  std::uint32_t attachments_ = 0, metadata_ = 0;
  std::uint64_t messages_ = 0;
  std::map<ChannelId, std::uint64_t> message_counts_;
  Stamp start_ = 0, end_ = 0;
};

}  // namespace cosight::recording
