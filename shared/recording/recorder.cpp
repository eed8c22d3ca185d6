#include "shared/recording/recorder.hpp"

#include <algorithm>
#include <chrono>
#include <exception>
#include <map>
#include <mutex>
#include <thread>
#include <utility>

#include "shared/recording/message_store.hpp"
#include "shared/transport/blind_topic.hpp"

namespace cosight::recording {
namespace {

using Clock = std::chrono::steady_clock;
using std::chrono::milliseconds;
using transport::BlindTopic;

constexpr milliseconds kLookForTopics{50};
constexpr milliseconds kTellProgress{500};
constexpr milliseconds kFlush{200};
constexpr milliseconds kLongestWait{25};

/// The middleware talks to itself too.
bool is_internal(const BlindTopic& topic) {
  return topic.name.starts_with("_fastdds_");
}

/// Readers that would be matched by the same writers are the same.
bool is_same(const BlindTopic& a, const BlindTopic& b) {
  return a.name == b.name && a.type == b.type && a.keyed == b.keyed && a.qos.reliable == b.qos.reliable &&
         a.qos.transient_local == b.qos.transient_local && a.qos.exclusive == b.qos.exclusive &&
         a.qos.partitions == b.qos.partitions;
}

}  // namespace

class Recorder::Impl {
 public:
  Impl(const transport::Participant& participant, RecorderOptions options, MessageSchemas schemas,
       SessionNotes notes)
      : participant_(participant),
        options_(std::move(options)),
        schemas_(std::move(schemas)),
        queue_(options_.queue_bytes),
        store_(options_, std::move(notes), topics_, ledger_) {}
  ~Impl() { stop_writing(); }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  RecordedSummary run(const std::atomic<bool>& stop, const std::atomic<int>& save, const Progress& progress) {
    thread_ = std::thread([this, &save] { write_until_done(save); });
    const auto began = Clock::now();
    auto told = began;
    while (!stop && !failed_) {
      look_for_topics();
      std::this_thread::sleep_for(kLookForTopics);
      const auto now = Clock::now();
      const std::chrono::duration<double> elapsed = now - began;
      if (options_.max_seconds > 0.0 && elapsed.count() >= options_.max_seconds) break;
      if (progress && now - told >= kTellProgress) {
        progress({topics_.size(), ledger_.total(), store_.bytes_written(), rings_saved_});
        told = now;
      }
    }
    readers_.clear();
    stop_writing();
    if (failure_) std::rethrow_exception(failure_);
    return {store_.paths(), ledger_.total(), store_.messages(), unrecorded_};
  }

 private:
  struct Reader {
    BlindTopic topic;
    std::unique_ptr<transport::BlindReader> reader;  ///< null: could not be made
  };

  void look_for_topics() {
    for (const transport::DiscoveredWriter& writer : transport::discovered_writers(participant_)) {
      if (is_internal(writer.topic) || !options_.topics.wants(writer.topic.name)) continue;
      const auto known = std::find_if(readers_.begin(), readers_.end(), [&](const Reader& reader) {
        return is_same(reader.topic, writer.topic);
      });
      if (known == readers_.end()) start_reading(writer);
    }
  }

  void start_reading(const transport::DiscoveredWriter& writer) {
    const BlindTopic& topic = writer.topic;
    const std::size_t reader = readers_.size();
    readers_.push_back({topic, nullptr});
    is_owner(writer.id, reader);
    const std::size_t index = topics_.add({describe(topic, schemas_), is_latched(topic)});
    try {
      readers_.back().reader = std::make_unique<transport::BlindReader>(
          participant_, topic,
          [this, index, reader](Bytes&& payload, const transport::BlindReception& reception) {
            receive(index, reader, std::move(payload), reception);
          });
    } catch (const transport::TransportError& error) {
      unrecorded_.emplace_back(error.what());
    }
  }

  void receive(std::size_t topic, std::size_t reader, Bytes&& payload,
               const transport::BlindReception& reception) {
    if (!is_owner(reception.writer_id, reader)) return;
    ledger_.received(topic, reception.writer_id, reception.sequence);
    const bool taken = queue_.push({.topic = topic,
                                    .sequence = reception.sequence,
                                    .log_time = reception.stamp,
                                    .publish_time = reception.source_stamp,
                                    .payload = std::move(payload)});
    if (!taken) ledger_.refused(topic);
  }

  /// A best-effort reader is matched by reliable writers too: of a writer's samples only those count that
  /// come to the first reader that was made for it.
  bool is_owner(const LossLedger::WriterId& writer, std::size_t reader) {
    const std::lock_guard lock(owner_mutex_);
    return owner_.try_emplace(writer, reader).first->second == reader;
  }

  void write_until_done(const std::atomic<int>& save) {
    try {
      std::vector<ReceivedMessage> messages;
      auto flushed = Clock::now();
      int saved = save;
      for (bool is_last = false; !is_last;) {
        is_last = done_;
        queue_.take(messages, is_last ? milliseconds{0} : kLongestWait);
        for (ReceivedMessage& message : messages)
          store_.add(std::move(message));
        if (const auto now = Clock::now(); now - flushed >= kFlush) {
          store_.flush();
          flushed = now;
        }
        for (; saved != save; ++saved, ++rings_saved_)
          store_.save_ring();
      }
      store_.close();
    } catch (const std::exception&) {
      failure_ = std::current_exception();
      failed_ = true;
    }
  }

  void stop_writing() {
    done_ = true;
    if (thread_.joinable()) thread_.join();
  }

  const transport::Participant& participant_;
  RecorderOptions options_;
  MessageSchemas schemas_;
  RecordedTopics topics_;
  LossLedger ledger_;
  MessageQueue queue_;
  MessageStore store_;
  std::mutex owner_mutex_;
  std::map<LossLedger::WriterId, std::size_t> owner_;
  std::vector<std::string> unrecorded_;
  std::atomic<bool> done_ = false;
  std::atomic<bool> failed_ = false;
  std::atomic<std::uint64_t> rings_saved_ = 0;
  std::exception_ptr failure_;
  std::thread thread_;
  std::vector<Reader> readers_;  ///< last: their callbacks use all of the above
};

Recorder::Recorder(const transport::Participant& participant, RecorderOptions options, MessageSchemas schemas,
                   SessionNotes notes)
    : impl_(std::make_unique<Impl>(participant, std::move(options), std::move(schemas), std::move(notes))) {}
Recorder::~Recorder() = default;

RecordedSummary Recorder::run(const std::atomic<bool>& stop, const std::atomic<int>& save,
                              const Progress& progress) {
  return impl_->run(stop, save, progress);
}

}  // namespace cosight::recording
