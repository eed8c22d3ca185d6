#pragma once

#include <cstdint>
#include <optional>
#include <string>

#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

/// A chunk's fields before its records.
struct ChunkHead {
  Stamp start = 0, end = 0;
  std::uint64_t uncompressed_size = 0;
  std::uint32_t crc = 0;  ///< of the decompressed records; 0: none
  std::string compression;
  std::uint64_t size = 0;  ///< of the records as they lie in the file
  ByteView records;        ///< as many of them as there are
};

/// A record's content from anywhere, or nothing when a length or number in it is wrong. Views point into
/// `content`.
std::optional<Schema> parse_schema(ByteView content);
std::optional<Channel> parse_channel(ByteView content);
std::optional<Message> parse_message(ByteView content);
std::optional<Metadata> parse_metadata(ByteView content);
std::optional<ChunkHead> parse_chunk_head(ByteView content);

/// Calls `visit(Opcode, content, offset)` for each whole record, one after the other. False when bytes are
/// left over that are no record.
template <class Visit>
bool for_each_record(ByteView records, Visit visit) {
  const std::size_t size = records.size();
  while (records.size() >= kRecordHeadBytes) {
    std::uint64_t length = 0;
    for (std::size_t i = 0; i < sizeof length; ++i)
      length |= std::uint64_t{records[1 + i]} << (8 * i);
    if (length > records.size() - kRecordHeadBytes) return false;
    visit(static_cast<Opcode>(records[0]), records.subspan(kRecordHeadBytes, length), size - records.size());
    records = records.subspan(kRecordHeadBytes + length);
  }
  return records.empty();
}

}  // namespace cosight::recording
