#include "shared/recording/recording_files.hpp"

#include <algorithm>
#include <cstdio>
#include <utility>

namespace cosight::recording {
std::filesystem::path numbered(const std::filesystem::path& path, std::size_t number) {
  const std::string digits = std::to_string(number);
  const std::string zeros(digits.size() < 4 ? 4 - digits.size() : 0, '0');
  std::filesystem::path result = path;
  return result.replace_filename(path.stem().string() + "_" + zeros + digits + path.extension().string());
}

RecordingFiles::RecordingFiles(std::filesystem::path path, SplitOptions split, WriterOptions options,
                               SessionNotes notes)
    : path_(std::move(path)), split_(split), options_(std::move(options)), notes_(std::move(notes)) {
  open_next();
}

void RecordingFiles::open_next() {
  if (writer_) {
    writer_->close();
    finished_bytes_ += writer_->bytes_written();
    finished_messages_ += writer_->messages();
  }
  const bool is_split = split_.max_bytes > 0 || split_.max_duration > 0;
  const auto path = is_split ? numbered(path_, paths_.size() + 1) : path_;
  auto sink = std::make_unique<FileSink>(path);
  auto writer = std::make_unique<McapWriter>(*sink, options_);
  paths_.push_back(path);
  writer_ = std::move(writer);
  sink_ = std::move(sink);
  channels_.clear();
  schemas_.clear();
  first_.reset();
  Metadata session = notes_.session;
  session.entries["part"] = std::to_string(paths_.size());
  writer_->write(session);
  for (const Attachment& attachment : notes_.attachments)
    writer_->write(attachment);
}

bool RecordingFiles::is_full(Stamp log_time) const {
  const bool too_long = split_.max_duration > 0 && first_ && log_time - *first_ >= split_.max_duration;
  const bool too_large =
      split_.max_bytes > 0 && writer_->bytes_written() + writer_->bytes_waiting() >= split_.max_bytes;
  return first_ && (too_long || too_large);
}

ChannelId RecordingFiles::channel_of(std::size_t index, const RecordedTopic& topic) {
  if (index >= channels_.size()) channels_.resize(index + 1);
  if (channels_[index]) return *channels_[index];
  const auto& name = topic.schema.name;
  auto schema =
      std::find_if(schemas_.begin(), schemas_.end(), [&](const auto& s) { return s.first == name; });
  if (schema == schemas_.end()) {
    const SchemaId id = writer_->add_schema(name, topic.schema.encoding, topic.schema.text);
    schema = schemas_.insert(schemas_.end(), {name, id});
  }
  const Channel& channel = topic.channel;
  channels_[index] =
      writer_->add_channel(channel.topic, channel.message_encoding, schema->second, channel.metadata);
  return *channels_[index];
}

void RecordingFiles::write(const ReceivedMessage& message, const RecordedTopic& topic) {
  if (is_full(message.log_time)) open_next();
  if (!first_) first_ = message.log_time;
  writer_->write(Message{.channel_id = channel_of(message.topic, topic),
                         .sequence = static_cast<std::uint32_t>(message.sequence),
                         .log_time = message.log_time,
                         .publish_time = message.publish_time,
                         .payload = message.payload});
}

}  // namespace cosight::recording
