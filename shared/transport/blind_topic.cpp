#include "shared/transport/blind_topic.hpp"

#include <fastdds/rtps/common/WriteParams.h>

#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/DataReader.hpp>
#include <fastdds/dds/subscriber/DataReaderListener.hpp>
#include <fastdds/dds/subscriber/SampleInfo.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <mutex>
#include <utility>

#include "shared/transport/discovered_writers.hpp"
#include "shared/transport/participant_impl.hpp"
#include "shared/transport/participant_qos.hpp"
#include "shared/transport/payload_type.hpp"

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;
namespace legacy = eprosima::fastrtps;

namespace {

// Samples that a reader may be behind while its callback runs.
constexpr int kReaderDepth = 500;

legacy::Duration_t duration(double seconds) {
  return legacy::Duration_t(static_cast<long double>(seconds));
}

/// What the typed topics' writers and readers have, and then what the original writer offers. Not by the
/// topic's name, or an XML profile would be preferred to that.
TopicProfile unnamed(const BlindTopic& topic, int depth) {
  return {
      .name = "", .kind = {}, .frame_id = "", .depth = depth, .liveliness_lease = topic.qos.liveliness_lease};
}

template <class Qos>
void apply(const BlindQos& offered, Qos& qos) {
  qos.reliability().kind =
      offered.reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
  qos.durability().kind =
      offered.transient_local ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.ownership().kind = offered.exclusive ? dds::EXCLUSIVE_OWNERSHIP_QOS : dds::SHARED_OWNERSHIP_QOS;
}

template <class Qos>
Qos with_partitions(Qos qos, const BlindQos& offered) {
  for (const std::string& partition : offered.partitions)
    qos.partition().push_back(partition.c_str());
  return qos;
}

}  // namespace

std::vector<DiscoveredWriter> discovered_writers(const Participant& participant) {
  return participant.impl()->writers().all();
}

class BlindReader::Impl : private dds::DataReaderListener {
 public:
  Impl(const Participant& participant, const BlindTopic& topic, Receive receive)
      : participant_(participant.impl()), receive_(std::move(receive)) {
    subscriber_ =
        participant_->entity().create_subscriber(with_partitions(dds::SUBSCRIBER_QOS_DEFAULT, topic.qos));
    if (subscriber_ == nullptr) throw TransportError("DDS subscriber of " + topic.name + " can't be made");
    dds::DataReaderQos qos = reader_qos(unnamed(topic, kReaderDepth), *subscriber_);
    apply(topic.qos, qos);
    qos.liveliness() = {};  // whether the writer lives is not the recorder's business
    reader_ = subscriber_->create_datareader(&participant_->topic(topic.name, topic.type, topic.keyed), qos,
                                             this, dds::StatusMask::data_available());
    if (reader_ != nullptr) return;
    participant_->entity().delete_subscriber(subscriber_);
    throw TransportError("DDS reader of " + topic.name + " can't be made");
  }
  ~Impl() override {
    reader_->set_listener(nullptr);
    {
      const std::lock_guard lock(mutex_);  // a callback under way ends first, and is the last
      closed_ = true;
    }
    subscriber_->delete_datareader(reader_);
    participant_->entity().delete_subscriber(subscriber_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

 private:
  void on_data_available(dds::DataReader* reader) override {
    const std::lock_guard lock(mutex_);
    dds::SampleInfo sample;
    while (!closed_ &&
           reader->take_next_sample(&payload_, &sample) == legacy::types::ReturnCode_t::RETCODE_OK) {
      if (!sample.valid_data) continue;
      const auto& identity = sample.sample_identity;
      receive_(std::move(payload_), {.stamp = sample.reception_timestamp.to_ns(),
                                     .source_stamp = sample.source_timestamp.to_ns(),
                                     .writer_id = writer_id(identity.writer_guid()),
                                     .sequence = identity.sequence_number().to64long()});
      payload_ = {};
    }
  }

  std::shared_ptr<Participant::Impl> participant_;
  Receive receive_;
  std::mutex mutex_;
  bool closed_ = false;
  PayloadType::Payload payload_;
  dds::Subscriber* subscriber_ = nullptr;
  dds::DataReader* reader_ = nullptr;
};

BlindReader::BlindReader(const Participant& participant, const BlindTopic& topic, Receive receive)
    : impl_(std::make_unique<Impl>(participant, topic, std::move(receive))) {}
BlindReader::~BlindReader() = default;

class BlindWriter::Impl {
 public:
  Impl(const Participant& participant, const BlindTopic& topic, int depth)
      : participant_(participant.impl()) {
    publisher_ =
        participant_->entity().create_publisher(with_partitions(dds::PUBLISHER_QOS_DEFAULT, topic.qos));
    if (publisher_ == nullptr) throw TransportError("DDS publisher of " + topic.name + " can't be made");
    dds::DataWriterQos qos = writer_qos(unnamed(topic, depth), false, *publisher_);
    apply(topic.qos, qos);
    if (topic.qos.reliable) qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    if (topic.qos.deadline > 0.0) qos.deadline().period = duration(topic.qos.deadline);
    writer_ = publisher_->create_datawriter(&participant_->topic(topic.name, topic.type, topic.keyed), qos);
    if (writer_ != nullptr) return;
    participant_->entity().delete_publisher(publisher_);
    throw TransportError("DDS writer of " + topic.name + " can't be made");
  }
  ~Impl() {
    publisher_->delete_datawriter(writer_);
    participant_->entity().delete_publisher(publisher_);
  }
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  bool write(std::span<const std::uint8_t> payload, Stamp source_stamp) {
    payload_.assign(payload.begin(), payload.end());
    legacy::rtps::WriteParams parameters;
    legacy::rtps::Time_t stamp;
    stamp.from_ns(source_stamp);
    parameters.source_timestamp(stamp);
    return writer_->write(&payload_, parameters);
  }

  int readers() const {
    dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count;
  }

  bool wait_until_delivered(std::chrono::milliseconds timeout) {
    return writer_->wait_for_acknowledgments(duration(std::chrono::duration<double>(timeout).count())) ==
           legacy::types::ReturnCode_t::RETCODE_OK;
  }

 private:
  std::shared_ptr<Participant::Impl> participant_;
  PayloadType::Payload payload_;
  dds::Publisher* publisher_ = nullptr;
  dds::DataWriter* writer_ = nullptr;
};

BlindWriter::BlindWriter(const Participant& participant, const BlindTopic& topic, int depth)
    : impl_(std::make_unique<Impl>(participant, topic, depth)) {}
BlindWriter::~BlindWriter() = default;

bool BlindWriter::write(std::span<const std::uint8_t> payload, Stamp source_stamp) {
  return impl_->write(payload, source_stamp);
}
int BlindWriter::readers() const {
  return impl_->readers();
}
bool BlindWriter::wait_until_delivered(std::chrono::milliseconds timeout) {
  return impl_->wait_until_delivered(timeout);
}

}  // namespace cosight::transport
