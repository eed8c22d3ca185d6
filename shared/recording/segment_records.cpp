#include "shared/recording/segment_records.hpp"

#include "shared/recording/compression.hpp"
#include "shared/recording/crc32.hpp"
#include "shared/recording/parse_records.hpp"

namespace cosight::recording {

bool read_segment(const ByteSource& source, const Segment& segment, const ReaderLimits& limits,
                  Bytes& records) {
  records.clear();
  if (segment.offset > source.size() || segment.length > source.size() - segment.offset) return false;
  Bytes stored(segment.length);
  if (source.read(segment.offset, stored) != stored.size()) return false;
  if (!segment.is_chunk) {
    records = std::move(stored);
    return true;
  }
  if (stored.size() < kRecordHeadBytes || stored[0] != static_cast<std::uint8_t>(Opcode::kChunk))
    return false;
  const auto head = parse_chunk_head(ByteView(stored).subspan(kRecordHeadBytes));
  if (!head || head->uncompressed_size > limits.max_chunk_bytes) return false;
  const auto compression = compression_named(head->compression);
  if (!compression) return false;
  if (head->size != head->records.size()) {
    if (*compression == Compression::kNone) records.assign(head->records.begin(), head->records.end());
    return false;
  }
  const bool is_whole = decompress(*compression, head->records, head->uncompressed_size, records) &&
                        (head->crc == 0 || head->crc == crc32(records));
  if (!is_whole) records.clear();
  return is_whole;
}

}  // namespace cosight::recording
