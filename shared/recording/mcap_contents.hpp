#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <vector>

#include "shared/recording/byte_source.hpp"
#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

/// What a reader is willing to believe of a file that came from anywhere.
struct ReaderLimits {
  std::uint64_t max_chunk_bytes = std::uint64_t{256} << 20;  ///< decompressed; a larger chunk is damaged
};

/// A stretch of the file that holds messages: a chunk, or messages outside of chunks one after the other.
struct Segment {
  std::uint64_t offset = 0;  ///< of the first record, a chunk's own included
  std::uint64_t length = 0;
  bool is_chunk = false;
  Stamp start = 0, end = 0;         ///< log times
  std::vector<ChannelId> channels;  ///< that have messages in it; empty: not known
};

struct AttachmentEntry {
  std::uint64_t offset = 0, length = 0;  ///< of the record
  Stamp log_time = 0, create_time = 0;
  std::string name;
  std::string media_type;
  std::uint64_t bytes = 0;
};

/// Everything about a recording but its messages.
struct McapContents {
  std::string profile;
  std::string library;
  std::map<SchemaId, Schema> schemas;
  std::map<ChannelId, Channel> channels;
  std::map<ChannelId, std::uint64_t> message_counts;
  std::uint64_t messages = 0;
  Stamp start = 0, end = 0;  ///< log times of the first and last message
  std::vector<Segment> segments;
  std::vector<AttachmentEntry> attachments;
  std::vector<Metadata> metadata;
  bool is_indexed = false;    ///< read from the summary; else the whole file was gone through
  bool is_complete = true;    ///< the end is there
  std::uint64_t damaged = 0;  ///< chunks and records left out: checksum, length or content wrong
};

/// From the summary when there is a sound one, else by going through the file: unindexed, cut off or damaged,
/// all that is whole is found. Throws RecordingError only when it is no MCAP file at all.
McapContents read_contents(const ByteSource& source, const ReaderLimits& limits);

}  // namespace cosight::recording
