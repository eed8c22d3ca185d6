#include "shared/recording/message_store.hpp"

#include <utility>

namespace cosight::recording {

MessageStore::MessageStore(const RecorderOptions& options, SessionNotes notes, const RecordedTopics& topics,
                           const LossLedger& ledger)
    : options_(options), notes_(std::move(notes)), topics_(topics), ledger_(ledger) {
  if (options_.ring_seconds > 0.0)
    ring_.emplace(from_seconds(options_.ring_seconds));
  else
    files_.emplace(options_.path, options_.split, options_.writer, notes_);
}

void MessageStore::add(ReceivedMessage&& message) {
  const RecordedTopics::Entry& entry = topics_.at(message.topic);
  if (ring_)
    ring_->add(std::move(message), entry.is_latched);
  else
    files_->write(message, entry.topic);
}

/// A killed recorder never comes to its end: losses are noted as soon as there are more.
void MessageStore::flush() {
  if (!files_) return;
  const TopicCounters total = ledger_.total();
  if (total.lost + total.refused > noted_losses_) files_->write(losses());
  noted_losses_ = total.lost + total.refused;
  files_->flush();
  note_progress(*files_);
}

void MessageStore::save_ring() {
  if (!ring_) return;
  RecordingFiles files(numbered(options_.path, ++rings_saved_), {}, options_.writer, notes_);
  ring_->for_each(
      [&](const ReceivedMessage& message) { files.write(message, topics_.at(message.topic).topic); });
  files.write(losses());
  files.close();
  messages_ += files.messages();
  bytes_written_ += files.bytes_written();
  paths_.push_back(files.paths().front());
}

void MessageStore::close() {
  if (!files_) return;
  files_->write(losses());
  files_->close();
  note_progress(*files_);
}

void MessageStore::note_progress(const RecordingFiles& files) {
  bytes_written_ = files.bytes_written();
  messages_ = files.messages();
  paths_ = files.paths();
}

Metadata MessageStore::losses() const {
  Metadata metadata{"cosight.losses", {}};
  for (std::size_t i = 0; i < topics_.size(); ++i) {
    const TopicCounters counters = ledger_.of(i);
    metadata.entries[topics_.at(i).topic.channel.topic] = "received=" + std::to_string(counters.received) +
                                                          " lost=" + std::to_string(counters.lost) +
                                                          " refused=" + std::to_string(counters.refused);
  }
  return metadata;
}

}  // namespace cosight::recording
