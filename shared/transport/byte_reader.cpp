#include "shared/transport/byte_reader.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <bit>
#include <condition_variable>
#include <exception>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <map>
#include <mutex>
#include <utility>

#include "shared/transport/discovered_writers.hpp"
#include "shared/transport/participant_impl.hpp"
#include "shared/transport/participant_qos.hpp"
#include "shared/transport/payload_type.hpp"

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

Reception reception_of(const dds::SampleInfo& sample, const rtps::GUID_t& reader) {
  const rtps::GUID_t& writer = sample.sample_identity.writer_guid();
  return {.stamp = sample.reception_timestamp.to_ns(),
          .writer_id = writer_id(writer),
          .sequence = sample.sample_identity.sequence_number().to64long(),
          .from_own_process = writer.guidPrefix == reader.guidPrefix};
}

}  // namespace

class ByteReader::Impl : private dds::DataReaderListener {
 public:
  Impl(const Participant& participant, const TopicProfile& topic, Receive receive, Gone gone)
      : participant_(participant.impl()),
        topic_(topic),
        receive_(std::move(receive)),
        gone_(std::move(gone)) {
    const dds::DataReaderQos qos = reader_qos(topic, participant_->subscriber());
    reader_ = participant_->subscriber().create_datareader(&participant_->topic(topic), qos, this,
                                                           dds::StatusMask::all());
    if (reader_ == nullptr) {
      throw TransportError("DDS reader of " + std::string(topic.name) +
                           " could not be created: is its profile consistent?");
    }
  }
  ~Impl() override {
    reader_->set_listener(nullptr);
    {
      const std::lock_guard lock(receive_mutex_);  // a callback under way ends first, and is the last
      closed_ = true;
    }
    {
      const std::lock_guard lock(gone_mutex_);
      gone_ = nullptr;
    }
    participant_->subscriber().delete_datareader(reader_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool wait_for_writers(int writers, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return matched_.wait_for(lock, timeout, [&] { return counters_.writers >= writers; });
  }

  SubscriberCounters counters() const {
    const std::lock_guard lock(mutex_);
    return counters_;
  }

 private:
  void on_data_available(dds::DataReader* reader) override {
    const std::lock_guard lock(receive_mutex_);
    dds::SampleInfo sample;
    while (!closed_ && reader->take_next_sample(&payload_, &sample) ==
                           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK) {
      if (sample.valid_data) receive(reception_of(sample, reader->guid()));
    }
  }

  // Nothing that a peer sends, and nothing that a callback throws, may end the middleware's thread.
  void receive(const Reception& reception) {
    count_arrival(reception);
    try {
      count_result(receive_(payload_, reception));
    } catch (const std::exception& error) {
      count_failed_callback(error.what());
    } catch (...) {
      count_failed_callback("unknown exception");
    }
  }

  void count_arrival(const Reception& reception) {
    const std::lock_guard lock(mutex_);
    counters_.bytes += payload_.size();
    std::uint64_t& last = last_sequence_[reception.writer_id];
    if (last != 0 && reception.sequence > last + 1) counters_.lost += reception.sequence - last - 1;
    last = std::max(last, reception.sequence);
  }

  void count_result(Fault fault) {
    const std::lock_guard lock(mutex_);
    if (fault == Fault::kNone) {
      ++counters_.received;
      return;
    }
    counters_.last_fault = fault;
    if (std::has_single_bit(++counters_.invalid)) {
      spdlog::warn("transport: {}: sample dropped: {} ({} x)", topic_.name, to_string(fault),
                   counters_.invalid);
    }
  }

  void count_failed_callback(const char* reason) {
    const std::lock_guard lock(mutex_);
    if (std::has_single_bit(++counters_.callback_failed)) {
      spdlog::error("transport: {}: receiving a sample failed: {} ({} x)", topic_.name, reason,
                    counters_.callback_failed);
    }
  }

  void on_subscription_matched(dds::DataReader* /*reader*/,
                               const dds::SubscriptionMatchedStatus& status) override {
    const bool came = status.current_count_change > 0;
    const WriterId writer = writer_id(rtps::iHandle2GUID(status.last_publication_handle));
    {
      const std::lock_guard lock(mutex_);
      counters_.writers = status.current_count;
      ++(came ? counters_.matched : counters_.unmatched);
      if (!came) last_sequence_.erase(writer);
    }
    spdlog::info("transport: {}: a writer {}, now {}", topic_.name, came ? "matched" : "left",
                 status.current_count);
    matched_.notify_all();
    if (!came) tell_gone(writer);
  }

  void on_liveliness_changed(dds::DataReader* /*reader*/,
                             const dds::LivelinessChangedStatus& status) override {
    if (status.not_alive_count_change <= 0) return;
    {
      const std::lock_guard lock(mutex_);
      ++counters_.liveliness_lost;
    }
    spdlog::warn("transport: {}: a writer fell silent", topic_.name);
    tell_gone(writer_id(rtps::iHandle2GUID(status.last_publication_handle)));
  }

  void tell_gone(const WriterId& writer) {
    const std::lock_guard lock(gone_mutex_);
    if (gone_) gone_(writer);
  }

  void on_requested_incompatible_qos(dds::DataReader* /*reader*/,
                                     const dds::RequestedIncompatibleQosStatus& status) override {
    const std::lock_guard lock(mutex_);
    ++counters_.incompatible_qos;
    spdlog::warn("transport: {}: a writer offers less than is asked for (QoS policy {})", topic_.name,
                 static_cast<int>(status.last_policy_id));
  }

  std::shared_ptr<Participant::Impl> participant_;
  const TopicProfile& topic_;
  Receive receive_;
  Gone gone_;
  std::mutex gone_mutex_;  ///< not receive_mutex_: the middleware may hold its own while it tells of a writer
  std::mutex receive_mutex_;  ///< taken before mutex_
  bool closed_ = false;
  PayloadType::Payload payload_;
  mutable std::mutex mutex_;  ///< of the counters; never held while the middleware or the callback is called
  mutable std::condition_variable matched_;
  SubscriberCounters counters_;
  std::map<WriterId, std::uint64_t> last_sequence_;
  dds::DataReader* reader_ = nullptr;  ///< last: its callbacks use all of the above
};

ByteReader::ByteReader(const Participant& participant, const TopicProfile& topic, Receive receive, Gone gone)
    : impl_(std::make_unique<Impl>(participant, topic, std::move(receive), std::move(gone))) {}
ByteReader::~ByteReader() = default;

bool ByteReader::wait_for_writers(int writers, std::chrono::milliseconds timeout) const {
  return impl_->wait_for_writers(writers, timeout);
}
SubscriberCounters ByteReader::counters() const {
  return impl_->counters();
}

}  // namespace cosight::transport
