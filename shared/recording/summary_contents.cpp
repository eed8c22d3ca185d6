#include "shared/recording/summary_contents.hpp"

#include <algorithm>
#include <array>
#include <utility>

#include "shared/recording/crc32.hpp"
#include "shared/recording/field_reader.hpp"
#include "shared/recording/parse_records.hpp"

namespace cosight::recording {
namespace {

constexpr std::uint64_t kEndBytes = kFooterBytes + kMagic.size();

bool is_inside(const ByteSource& source, std::uint64_t offset, std::uint64_t length) {
  return offset <= source.size() && length <= source.size() - offset;
}

/// The summary's records, checked; nothing when there are none.
std::optional<Bytes> read_summary(const ByteSource& source) {
  if (source.size() < kMagic.size() + kEndBytes) return std::nullopt;
  const std::uint64_t footer_start = source.size() - kEndBytes;
  std::array<std::uint8_t, kEndBytes> end{};
  if (source.read(footer_start, end) != end.size()) return std::nullopt;
  if (!std::equal(kMagic.begin(), kMagic.end(), end.end() - kMagic.size())) return std::nullopt;
  FieldReader footer(ByteView(end).first(kFooterBytes));
  const auto opcode = footer.number<std::uint8_t>();
  const auto length = footer.number<std::uint64_t>();
  const auto start = footer.number<std::uint64_t>();
  footer.number<std::uint64_t>();  // where the offsets start: a short cut that isn't taken
  const auto crc = footer.number<std::uint32_t>();
  if (opcode != static_cast<std::uint8_t>(Opcode::kFooter) || length != kFooterBytes - kRecordHeadBytes)
    return std::nullopt;
  if (start == 0 || start > footer_start) return std::nullopt;
  Bytes summary(footer_start - start);
  if (source.read(start, summary) != summary.size()) return std::nullopt;
  Crc32 actual;
  actual.add(summary);
  actual.add(ByteView(end).first(kFooterBytes - sizeof crc));
  if (crc != 0 && crc != actual.value()) return std::nullopt;
  return summary;
}

std::optional<Segment> parse_chunk_index(ByteView content) {
  FieldReader fields(content);
  Segment segment;
  segment.is_chunk = true;
  segment.start = fields.time();
  segment.end = fields.time();
  segment.offset = fields.number<std::uint64_t>();
  segment.length = fields.number<std::uint64_t>();
  FieldReader indexes(fields.sized<std::uint32_t>());
  while (indexes.good() && !indexes.at_end()) {
    segment.channels.push_back(indexes.number<ChannelId>());
    indexes.number<std::uint64_t>();
  }
  return fields.good() && indexes.good() ? std::optional(std::move(segment)) : std::nullopt;
}

std::optional<AttachmentEntry> parse_attachment_index(ByteView content) {
  FieldReader fields(content);
  AttachmentEntry entry;
  entry.offset = fields.number<std::uint64_t>();
  entry.length = fields.number<std::uint64_t>();
  entry.log_time = fields.time();
  entry.create_time = fields.time();
  entry.bytes = fields.number<std::uint64_t>();
  entry.name = fields.text();
  entry.media_type = fields.text();
  return fields.good() ? std::optional(std::move(entry)) : std::nullopt;
}

/// Collects the summary; false with the first record that can't be believed.
class SummaryReader {
 public:
  explicit SummaryReader(const ByteSource& source) : source_(source) {}

  bool take(Opcode opcode, ByteView content) {
    switch (opcode) {
      case Opcode::kSchema:
        return keep(parse_schema(content), contents_.schemas);
      case Opcode::kChannel:
        return keep(parse_channel(content), contents_.channels);
      case Opcode::kChunkIndex:
        return take_segment(parse_chunk_index(content));
      case Opcode::kAttachmentIndex:
        return take_attachment(parse_attachment_index(content));
      case Opcode::kMetadataIndex:
        return take_metadata(content);
      case Opcode::kStatistics:
        return take_statistics(content);
      default:
        return true;
    }
  }

  /// Nothing when the summary leaves something out that only the whole file can tell.
  std::optional<McapContents> finish() {
    const auto known = [this](ChannelId id) { return contents_.channels.contains(id); };
    const bool all_known =
        std::all_of(contents_.segments.begin(), contents_.segments.end(), [&](const Segment& segment) {
          return std::all_of(segment.channels.begin(), segment.channels.end(), known);
        });
    const bool all_there = has_statistics_ && channels_said_ == contents_.channels.size() &&
                           chunks_said_ == contents_.segments.size() &&
                           attachments_said_ == contents_.attachments.size() &&
                           metadata_said_ == contents_.metadata.size() &&
                           (contents_.messages == 0 || !contents_.segments.empty());
    if (!all_known || !all_there) return std::nullopt;
    std::stable_sort(contents_.segments.begin(), contents_.segments.end(),
                     [](const Segment& a, const Segment& b) { return a.offset < b.offset; });
    contents_.is_indexed = true;
    return std::move(contents_);
  }

 private:
  template <class Record, class Map>
  static bool keep(std::optional<Record> record, Map& map) {
    if (!record) return false;
    const auto id = record->id;
    map.insert_or_assign(id, std::move(*record));
    return true;
  }

  bool take_segment(std::optional<Segment> segment) {
    if (!segment || !is_inside(source_, segment->offset, segment->length)) return false;
    contents_.segments.push_back(std::move(*segment));
    return true;
  }

  bool take_attachment(std::optional<AttachmentEntry> entry) {
    if (!entry || !is_inside(source_, entry->offset, entry->length)) return false;
    contents_.attachments.push_back(std::move(*entry));
    return true;
  }

  bool take_metadata(ByteView content) {
    FieldReader fields(content);
    const auto offset = fields.number<std::uint64_t>();
    const auto length = fields.number<std::uint64_t>();
    if (!fields.good() || length < kRecordHeadBytes || !is_inside(source_, offset, length)) return false;
    Bytes record(length);
    if (source_.read(offset, record) != record.size()) return false;
    auto metadata = parse_metadata(ByteView(record).subspan(kRecordHeadBytes));
    if (!metadata) return false;
    contents_.metadata.push_back(std::move(*metadata));
    return true;
  }

  bool take_statistics(ByteView content) {
    FieldReader fields(content);
    contents_.messages = fields.number<std::uint64_t>();
    fields.number<std::uint16_t>();  // schemas
    channels_said_ = fields.number<std::uint32_t>();
    attachments_said_ = fields.number<std::uint32_t>();
    metadata_said_ = fields.number<std::uint32_t>();
    chunks_said_ = fields.number<std::uint32_t>();
    contents_.start = fields.time();
    contents_.end = fields.time();
    FieldReader counts(fields.sized<std::uint32_t>());
    while (counts.good() && !counts.at_end()) {
      const auto channel = counts.number<ChannelId>();
      contents_.message_counts[channel] = counts.number<std::uint64_t>();
    }
    has_statistics_ = true;
    return fields.good() && counts.good();
  }

  const ByteSource& source_;
  McapContents contents_;
  bool has_statistics_ = false;
  std::uint64_t channels_said_ = 0, chunks_said_ = 0, attachments_said_ = 0, metadata_said_ = 0;
};

}  // namespace

bool read_header(const ByteSource& source, McapContents& contents) {
  std::array<std::uint8_t, kRecordHeadBytes> head{};
  if (source.read(kMagic.size(), head) != head.size()) return false;
  FieldReader head_fields(head);
  const auto opcode = head_fields.number<std::uint8_t>();
  const auto length = head_fields.number<std::uint64_t>();
  const std::uint64_t start = kMagic.size() + kRecordHeadBytes;
  if (opcode != static_cast<std::uint8_t>(Opcode::kHeader) || !is_inside(source, start, length)) return false;
  Bytes content(length);
  if (source.read(start, content) != content.size()) return false;
  FieldReader fields(content);
  contents.profile = fields.text();
  contents.library = fields.text();
  return fields.good();
}

std::optional<McapContents> summary_contents(const ByteSource& source) {
  const auto summary = read_summary(source);
  if (!summary) return std::nullopt;
  SummaryReader reader(source);
  bool is_sound = true;
  const bool is_whole = for_each_record(*summary, [&](Opcode opcode, ByteView content, std::uint64_t) {
    is_sound = is_sound && reader.take(opcode, content);
  });
  if (!is_whole || !is_sound) return std::nullopt;
  auto contents = reader.finish();
  if (contents) read_header(source, *contents);
  return contents;
}

}  // namespace cosight::recording
