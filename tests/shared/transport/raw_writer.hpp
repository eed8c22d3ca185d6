#pragma once

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <cstdint>
#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/dds/publisher/DataWriter.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <memory>
#include <stdexcept>
#include <string>
#include <vector>

#include "shared/transport/payload_type.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

/// A peer that is no Cosight: plain Fast DDS with its defaults, any bytes under any topic's name and type.
class RawWriter {
 public:
  RawWriter(int domain, const TopicProfile& topic, bool reliable = true) {
    namespace dds = eprosima::fastdds::dds;
    const std::string type(type_name(topic.kind));
    auto loopback_only = std::make_shared<eprosima::fastdds::rtps::UDPv4TransportDescriptor>();
    loopback_only->interfaceWhiteList.emplace_back("127.0.0.1");
    dds::DomainParticipantQos participant_qos;
    participant_qos.transport().use_builtin_transports = false;
    participant_qos.transport().user_transports.push_back(loopback_only);
    participant_ = dds::DomainParticipantFactory::get_instance()->create_participant(
        static_cast<dds::DomainId_t>(domain), participant_qos);
    if (participant_ == nullptr) throw std::runtime_error("no participant");
    participant_->register_type(dds::TypeSupport(new PayloadType(type)));
    dds::Publisher* publisher = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
    dds::Topic* dds_topic = participant_->create_topic(std::string(topic.name), type, dds::TOPIC_QOS_DEFAULT);
    dds::DataWriterQos qos;
    qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;
    qos.reliability().kind = reliable ? dds::RELIABLE_RELIABILITY_QOS : dds::BEST_EFFORT_RELIABILITY_QOS;
    qos.history().kind = dds::KEEP_ALL_HISTORY_QOS;
    writer_ = publisher->create_datawriter(dds_topic, qos);
    if (writer_ == nullptr) throw std::runtime_error("no writer");
  }
  ~RawWriter() {
    participant_->delete_contained_entities();
    eprosima::fastdds::dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
  }
  RawWriter(const RawWriter&) = delete;
  RawWriter& operator=(const RawWriter&) = delete;

  /// Matched on this side too: what is written before that is not for a VOLATILE reader.
  bool has_reader() const {
    eprosima::fastdds::dds::PublicationMatchedStatus status;
    writer_->get_publication_matched_status(status);
    return status.current_count > 0;
  }

  bool write(std::vector<std::uint8_t> payload) { return writer_->write(&payload); }

 private:
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::DataWriter* writer_ = nullptr;
};

}  // namespace cosight::transport
