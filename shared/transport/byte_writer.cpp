#include "shared/transport/byte_writer.hpp"

#include <spdlog/spdlog.h>

#include <bit>
#include <condition_variable>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/DataWriterListener.hpp>
#include <mutex>

#include "shared/transport/participant_impl.hpp"
#include "shared/transport/participant_qos.hpp"
#include "shared/transport/payload_type.hpp"

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;

namespace {

using Clock = std::chrono::steady_clock;
constexpr auto kStall = std::chrono::milliseconds(100);

}  // namespace

class ByteWriter::Impl : private dds::DataWriterListener {
 public:
  Impl(const Participant& participant, const TopicProfile& topic)
      : participant_(participant.impl()), topic_(topic) {
    const dds::DataWriterQos qos = writer_qos(topic, participant_->paced(), participant_->publisher());
    writer_ = participant_->publisher().create_datawriter(&participant_->topic(topic), qos, this,
                                                          dds::StatusMask::all());
    if (writer_ == nullptr) {
      throw TransportError("DDS writer of " + std::string(topic.name) +
                           " could not be created: is its profile consistent?");
    }
  }
  ~Impl() override {
    writer_->set_listener(nullptr);
    participant_->publisher().delete_datawriter(writer_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool write(const std::function<Fault(PayloadType::Payload&)>& encode) {
    const std::lock_guard lock(write_mutex_);
    if (const Fault fault = encode(payload_); fault != Fault::kNone) {
      count_failure(&PublisherCounters::refused, to_string(fault));
      return false;
    }
    const Clock::time_point start = Clock::now();
    const bool taken = writer_->write(&payload_);
    if (Clock::now() - start > kStall)
      count_failure(&PublisherCounters::stalled, "publishing took over 100 ms");
    if (!taken) {
      count_failure(&PublisherCounters::failed, "the middleware did not take the sample");
      return false;
    }
    const std::lock_guard counters_lock(mutex_);
    ++counters_.sent;
    counters_.bytes += payload_.size();
    return true;
  }

  bool wait_for_readers(int readers, std::chrono::milliseconds timeout) const {
    std::unique_lock lock(mutex_);
    return matched_.wait_for(lock, timeout, [&] { return counters_.readers >= readers; });
  }

  bool wait_until_delivered(std::chrono::milliseconds timeout) {
    const auto seconds = std::chrono::duration<long double>(timeout).count();
    return writer_->wait_for_acknowledgments(eprosima::fastrtps::Duration_t(seconds)) ==
           eprosima::fastrtps::types::ReturnCode_t::RETCODE_OK;
  }

  PublisherCounters counters() const {
    const std::lock_guard lock(mutex_);
    return counters_;
  }

 private:
  void on_publication_matched(dds::DataWriter* /*writer*/,
                              const dds::PublicationMatchedStatus& status) override {
    const std::lock_guard lock(mutex_);
    counters_.readers = status.current_count;
    ++(status.current_count_change > 0 ? counters_.matched : counters_.unmatched);
    spdlog::info("transport: {}: a reader {}, now {}", topic_.name,
                 status.current_count_change > 0 ? "matched" : "left", status.current_count);
    matched_.notify_all();
  }

  void on_offered_incompatible_qos(dds::DataWriter* /*writer*/,
                                   const dds::OfferedIncompatibleQosStatus& status) override {
    const std::lock_guard lock(mutex_);
    ++counters_.incompatible_qos;
    spdlog::warn("transport: {}: a reader asks for more than is offered (QoS policy {})", topic_.name,
                 static_cast<int>(status.last_policy_id));
  }

  void on_liveliness_lost(dds::DataWriter* /*writer*/, const dds::LivelinessLostStatus& /*status*/) override {
    const std::lock_guard lock(mutex_);
    ++counters_.liveliness_lost;
    spdlog::warn("transport: {}: this process is too busy to show that it lives", topic_.name);
  }

  void count_failure(std::uint64_t PublisherCounters::*counter, const char* reason) {
    const std::lock_guard lock(mutex_);
    const std::uint64_t count = ++(counters_.*counter);
    if (std::has_single_bit(count)) spdlog::warn("transport: {}: {} ({} x)", topic_.name, reason, count);
  }

  std::shared_ptr<Participant::Impl> participant_;
  const TopicProfile& topic_;
  std::mutex write_mutex_;
  PayloadType::Payload payload_;
  mutable std::mutex mutex_;  ///< of the counters; never held while the middleware is called
  mutable std::condition_variable matched_;
  PublisherCounters counters_;
  dds::DataWriter* writer_ = nullptr;  ///< last: its callbacks use all of the above
};

ByteWriter::ByteWriter(const Participant& participant, const TopicProfile& topic)
    : impl_(std::make_unique<Impl>(participant, topic)) {}
ByteWriter::~ByteWriter() = default;

bool ByteWriter::write(const std::function<Fault(std::vector<std::uint8_t>&)>& encode) {
  return impl_->write(encode);
}
bool ByteWriter::wait_for_readers(int readers, std::chrono::milliseconds timeout) const {
  return impl_->wait_for_readers(readers, timeout);
}
bool ByteWriter::wait_until_delivered(std::chrono::milliseconds timeout) {
  return impl_->wait_until_delivered(timeout);
}
PublisherCounters ByteWriter::counters() const {
  return impl_->counters();
}

}  // namespace cosight::transport
