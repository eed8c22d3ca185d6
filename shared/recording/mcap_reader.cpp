#include "shared/recording/mcap_reader.hpp"

#include <algorithm>
#include <utility>

#include "shared/recording/crc32.hpp"
#include "shared/recording/field_reader.hpp"
#include "shared/recording/file_bytes.hpp"
#include "shared/recording/parse_records.hpp"
#include "shared/recording/segment_records.hpp"

namespace cosight::recording {

struct MessageCursor::Loaded {
  Bytes records;
  std::vector<Message> messages;  ///< wanted, in the cursor's order
  std::size_t next = 0;
};

MessageCursor::MessageCursor(const ByteSource& source, const McapContents& contents,
                             const ReaderLimits& limits, const MessageFilter& filter, MessageOrder order)
    : source_(source), limits_(limits), start_(filter.start), end_(filter.end), order_(order) {
  for (const auto& [id, channel] : contents.channels) {
    wanted_.resize(id + std::size_t{1});
    wanted_[id] = !filter.wants || filter.wants(channel);
  }
  for (const Segment& segment : contents.segments) {
    const auto wanted = [this](ChannelId id) { return id < wanted_.size() && wanted_[id]; };
    const bool in_time = segment.start <= end_ && segment.end >= start_;
    const bool has_wanted =
        segment.channels.empty() || std::any_of(segment.channels.begin(), segment.channels.end(), wanted);
    if (in_time && has_wanted) segments_.push_back(&segment);
  }
  if (order_ != MessageOrder::kLogTime) return;
  std::stable_sort(segments_.begin(), segments_.end(),
                   [](const Segment* a, const Segment* b) { return a->start < b->start; });
}

MessageCursor::~MessageCursor() = default;
MessageCursor::MessageCursor(MessageCursor&& other) noexcept = default;

void MessageCursor::load(std::size_t segment) {
  auto loaded = std::make_unique<Loaded>();
  if (!read_segment(source_, *segments_[segment], limits_, loaded->records)) ++damaged_;
  for_each_record(loaded->records, [&](Opcode opcode, ByteView content, std::uint64_t) {
    if (opcode != Opcode::kMessage) return;
    const auto message = parse_message(content);
    if (!message || message->channel_id >= wanted_.size() || !wanted_[message->channel_id]) return;
    if (message->log_time < start_ || message->log_time > end_) return;
    loaded->messages.push_back(*message);
  });
  if (loaded->messages.empty()) return;
  if (order_ == MessageOrder::kLogTime) {
    std::stable_sort(loaded->messages.begin(), loaded->messages.end(),
                     [](const Message& a, const Message& b) { return a.log_time < b.log_time; });
  }
  loaded_.push_back(std::move(loaded));
}

/// In the order of log times: every segment that begins before the earliest message at hand, for it may hold
/// an earlier one.
void MessageCursor::load_what_is_due() {
  while (next_segment_ < segments_.size()) {
    const bool is_due = loaded_.empty() ||
                        (order_ == MessageOrder::kLogTime &&
                         std::any_of(loaded_.begin(), loaded_.end(), [&](const auto& loaded) {
                           return segments_[next_segment_]->start <= loaded->messages[loaded->next].log_time;
                         }));
    if (!is_due) return;
    load(next_segment_++);
  }
}

std::optional<Message> MessageCursor::next() {
  if (current_ != nullptr && ++current_->next == current_->messages.size())
    std::erase_if(loaded_, [this](const auto& loaded) { return loaded.get() == current_; });
  current_ = nullptr;
  load_what_is_due();
  for (const auto& loaded : loaded_) {
    const auto time = [](const Loaded& l) { return l.messages[l.next].log_time; };
    if (current_ == nullptr || time(*loaded) < time(*current_)) current_ = loaded.get();
  }
  if (current_ == nullptr) return std::nullopt;
  return current_->messages[current_->next];
}

McapReader::McapReader(std::unique_ptr<ByteSource> source, const ReaderLimits& limits)
    : source_(std::move(source)), limits_(limits), contents_(read_contents(*source_, limits)) {}

McapReader::McapReader(const std::filesystem::path& path) : McapReader(std::make_unique<FileSource>(path)) {}

MessageCursor McapReader::messages(const MessageFilter& filter, MessageOrder order) const {
  return {*source_, contents_, limits_, filter, order};
}

std::optional<Attachment> McapReader::attachment(const AttachmentEntry& entry) const {
  if (entry.length < kRecordHeadBytes || entry.length > source_->size()) return std::nullopt;
  Bytes content(entry.length - kRecordHeadBytes);
  if (source_->read(entry.offset + kRecordHeadBytes, content) != content.size()) return std::nullopt;
  FieldReader fields(content);
  Attachment attachment;
  attachment.log_time = fields.time();
  attachment.create_time = fields.time();
  attachment.name = fields.text();
  attachment.media_type = fields.text();
  const ByteView data = fields.sized<std::uint64_t>();
  const ByteView covered = ByteView(content).first(content.size() - fields.rest().size());
  const auto crc = fields.number<std::uint32_t>();
  if (!fields.good() || (crc != 0 && crc != crc32(covered))) return std::nullopt;
  attachment.data.assign(data.begin(), data.end());
  return attachment;
}

const Metadata* McapReader::metadata(std::string_view name) const {
  const auto& all = contents_.metadata;
  const auto last =
      std::find_if(all.rbegin(), all.rend(), [name](const Metadata& one) { return one.name == name; });
  return last == all.rend() ? nullptr : &*last;
}

const Schema* McapReader::schema_of(const Channel& channel) const {
  const auto found = contents_.schemas.find(channel.schema_id);
  return found == contents_.schemas.end() ? nullptr : &found->second;
}

}  // namespace cosight::recording
