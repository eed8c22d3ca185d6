#include "shared/recording/scanned_contents.hpp"

#include <algorithm>
#include <array>
#include <optional>
#include <utility>

#include "shared/recording/field_reader.hpp"
#include "shared/recording/parse_records.hpp"
#include "shared/recording/segment_records.hpp"
#include "shared/recording/summary_contents.hpp"

namespace cosight::recording {
namespace {

// Messages outside of chunks are read in pieces of about this size [bytes].
constexpr std::uint64_t kLoosePiece = std::uint64_t{4} << 20;

class Scanner {
 public:
  Scanner(const ByteSource& source, const ReaderLimits& limits) : source_(source), limits_(limits) {}

  McapContents run() {
    read_header(source_, contents_);
    while (!at_end_ && take_next_record()) {
    }
    contents_.is_complete = at_end_;
    return std::move(contents_);
  }

 private:
  /// False at the end of what makes sense.
  bool take_next_record() {
    std::array<std::uint8_t, kRecordHeadBytes> head{};
    const std::size_t head_bytes = source_.read(position_, head);
    if (head_bytes != head.size() || head[0] == 0) return false;
    FieldReader fields(head);
    const auto opcode = static_cast<Opcode>(fields.number<std::uint8_t>());
    const auto length = fields.number<std::uint64_t>();
    const std::uint64_t rest = source_.size() - position_ - kRecordHeadBytes;
    if (length > rest) {
      if (opcode == Opcode::kChunk) take_chunk(kRecordHeadBytes + rest);
      return false;
    }
    take(opcode, kRecordHeadBytes + length);
    position_ += kRecordHeadBytes + length;
    return true;
  }

  void take(Opcode opcode, std::uint64_t length) {
    switch (opcode) {
      case Opcode::kMessage:
        return take_message(length);
      case Opcode::kChunk:
        return take_chunk(length);
      case Opcode::kSchema:
      case Opcode::kChannel:
        return register_record(opcode, content(length));
      case Opcode::kMetadata:
        return keep(parse_metadata(content(length)), contents_.metadata);
      case Opcode::kAttachment:
        return take_attachment(length);
      case Opcode::kDataEnd:
      case Opcode::kFooter:
        at_end_ = true;
        return;
      default:
        return;
    }
  }

  /// Of the record at the present position, into a buffer that the next one overwrites.
  ByteView content(std::uint64_t length) {
    buffer_.resize(length - kRecordHeadBytes);
    const std::size_t count = source_.read(position_ + kRecordHeadBytes, buffer_);
    return ByteView(buffer_).first(count);
  }

  template <class Record>
  void keep(std::optional<Record> record, std::vector<Record>& records) {
    if (record)
      records.push_back(std::move(*record));
    else
      ++contents_.damaged;
  }

  void register_record(Opcode opcode, ByteView content) {
    if (opcode == Opcode::kSchema) {
      if (auto schema = parse_schema(content)) {
        contents_.schemas.insert_or_assign(schema->id, *schema);
        return;
      }
    } else if (auto channel = parse_channel(content)) {
      contents_.channels.insert_or_assign(channel->id, *channel);
      return;
    }
    ++contents_.damaged;
  }

  /// A message of a channel that nobody announced can't be read by anyone.
  void count(const std::optional<Message>& message, Segment& segment) {
    if (!message || !contents_.channels.contains(message->channel_id)) {
      ++contents_.damaged;
      return;
    }
    const bool is_first = contents_.messages == 0;
    const Stamp time = message->log_time;
    contents_.start = is_first ? time : std::min(contents_.start, time);
    contents_.end = is_first ? time : std::max(contents_.end, time);
    ++contents_.messages;
    ++contents_.message_counts[message->channel_id];
    segment.start = segment.channels.empty() ? time : std::min(segment.start, time);
    segment.end = segment.channels.empty() ? time : std::max(segment.end, time);
    const auto& channels = segment.channels;
    if (std::find(channels.begin(), channels.end(), message->channel_id) == channels.end())
      segment.channels.push_back(message->channel_id);
  }

  void take_message(std::uint64_t length) {
    std::array<std::uint8_t, kMessageHeadBytes> head{};
    const std::uint64_t content_length = std::min<std::uint64_t>(length - kRecordHeadBytes, head.size());
    source_.read(position_ + kRecordHeadBytes, std::span(head).first(content_length));
    const bool continues = !contents_.segments.empty() && !contents_.segments.back().is_chunk &&
                           contents_.segments.back().offset + contents_.segments.back().length == position_ &&
                           contents_.segments.back().length < kLoosePiece;
    if (!continues) contents_.segments.emplace_back().offset = position_;
    Segment& segment = contents_.segments.back();
    segment.length += length;
    count(parse_message(ByteView(head).first(content_length)), segment);
  }

  void take_chunk(std::uint64_t length) {
    Segment segment;
    segment.offset = position_;
    segment.length = length;
    segment.is_chunk = true;
    if (!read_segment(source_, segment, limits_, buffer_)) ++contents_.damaged;
    const bool is_whole = for_each_record(buffer_, [&](Opcode opcode, ByteView content, std::uint64_t) {
      if (opcode == Opcode::kMessage)
        count(parse_message(content), segment);
      else if (opcode == Opcode::kSchema || opcode == Opcode::kChannel)
        register_record(opcode, content);
    });
    if (!is_whole && length + position_ < source_.size()) ++contents_.damaged;
    if (!segment.channels.empty()) contents_.segments.push_back(std::move(segment));
  }

  void take_attachment(std::uint64_t length) {
    FieldReader fields(content(length));
    AttachmentEntry entry;
    entry.offset = position_;
    entry.length = length;
    entry.log_time = fields.time();
    entry.create_time = fields.time();
    entry.name = fields.text();
    entry.media_type = fields.text();
    entry.bytes = fields.sized<std::uint64_t>().size();
    if (fields.good())
      contents_.attachments.push_back(std::move(entry));
    else
      ++contents_.damaged;
  }

  const ByteSource& source_;
  ReaderLimits limits_;
  McapContents contents_;
  std::uint64_t position_ = kMagic.size();
  bool at_end_ = false;
  Bytes buffer_;
};

}  // namespace

McapContents scanned_contents(const ByteSource& source, const ReaderLimits& limits) {
  return Scanner(source, limits).run();
}

}  // namespace cosight::recording
