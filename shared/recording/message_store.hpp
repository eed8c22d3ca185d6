#pragma once

#include <atomic>
#include <deque>
#include <memory>
#include <mutex>
#include <optional>
#include <vector>

#include "shared/recording/loss_ledger.hpp"
#include "shared/recording/message_ring.hpp"
#include "shared/recording/recorder.hpp"
#include "shared/recording/recording_files.hpp"

namespace cosight::recording {

/// The topics of a recording as they are found; those that are there never change.
class RecordedTopics {
 public:
  struct Entry {
    RecordedTopic topic;
    bool is_latched = false;
  };

  std::size_t add(Entry entry) {
    const std::lock_guard lock(mutex_);
    topics_.push_back(std::move(entry));
    return topics_.size() - 1;
  }
  const Entry& at(std::size_t index) const {
    const std::lock_guard lock(mutex_);
    return topics_[index];
  }
  std::size_t size() const {
    const std::lock_guard lock(mutex_);
    return topics_.size();
  }

 private:
  mutable std::mutex mutex_;
  std::deque<Entry> topics_;
};

/// The disk's side of a recorder: everything into files at once, or into a ring that is saved when asked for.
/// One thread.
class MessageStore {
 public:
  /// `topics` and `ledger` have to outlive this. Throws RecordingError.
  MessageStore(const RecorderOptions& options, SessionNotes notes, const RecordedTopics& topics,
               const LossLedger& ledger);

  void add(ReceivedMessage&& message);
  /// What has been added is with the operating system when this returns.
  void flush();
  /// The ring as a file of its own; nothing happens without a ring.
  void save_ring();
  void close();

  std::uint64_t bytes_written() const { return bytes_written_; }
  std::uint64_t messages() const { return messages_; }
  const std::vector<std::filesystem::path>& paths() const { return paths_; }

 private:
  Metadata losses() const;
  void note_progress(const RecordingFiles& files);

  RecorderOptions options_;
  SessionNotes notes_;
  const RecordedTopics& topics_;
  const LossLedger& ledger_;
  std::optional<MessageRing> ring_;
  std::optional<RecordingFiles> files_;
  std::uint64_t noted_losses_ = 0;
  std::size_t rings_saved_ = 0;
  std::atomic<std::uint64_t> bytes_written_ = 0;
  std::uint64_t messages_ = 0;
  std::vector<std::filesystem::path> paths_;
};

}  // namespace cosight::recording
