#pragma once

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <vector>

#include "shared/recording/file_bytes.hpp"
#include "shared/recording/mcap_writer.hpp"
#include "shared/recording/message_queue.hpp"
#include "shared/recording/recorded_topic.hpp"

namespace cosight::recording {

/// When a recording goes on in another file.
struct SplitOptions {
  std::uint64_t max_bytes = 0;  ///< 0: never
  Stamp max_duration = 0;       ///< by reception; 0: never
};

/// What every file of a recording says about itself.
struct SessionNotes {
  std::vector<Attachment> attachments;
  Metadata session;  ///< versions, host
};

/// "trial_0001.mcap" for "trial.mcap".
std::filesystem::path numbered(const std::filesystem::path& path, std::size_t number);

/// One recording in one file or, with splitting, in several: `trial.mcap`, or `trial_0001.mcap` and so on,
/// each whole by itself. Every message is in exactly one.
class RecordingFiles {
 public:
  /// Throws RecordingError when the first file can't be made.
  RecordingFiles(std::filesystem::path path, SplitOptions split, WriterOptions options, SessionNotes notes);

  void write(const ReceivedMessage& message, const RecordedTopic& topic);
  void write(const Metadata& metadata) { writer_->write(metadata); }
  void flush() { writer_->flush(); }
  /// The last file's end.
  void close() { writer_->close(); }

  std::uint64_t bytes_written() const { return finished_bytes_ + writer_->bytes_written(); }
  std::uint64_t messages() const { return finished_messages_ + writer_->messages(); }
  const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  void open_next();
  bool is_full(Stamp log_time) const;
  ChannelId channel_of(std::size_t index, const RecordedTopic& topic);

  std::filesystem::path path_;
  SplitOptions split_;
  WriterOptions options_;
  SessionNotes notes_;
  std::vector<std::filesystem::path> paths_;
  std::unique_ptr<FileSink> sink_;
  std::unique_ptr<McapWriter> writer_;
  std::vector<std::optional<ChannelId>> channels_;  ///< of this file, by topic
  std::vector<std::pair<std::string, SchemaId>> schemas_;
  std::optional<Stamp> first_;  ///< log time in this file
  std::uint64_t finished_bytes_ = 0, finished_messages_ = 0;
};

}  // namespace cosight::recording
