#include "shared/transport/participant.hpp"

#include <spdlog/spdlog.h>

#include <algorithm>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>

#include "shared/transport/middleware_log.hpp"
#include "shared/transport/participant_impl.hpp"
#include "shared/transport/participant_qos.hpp"
#include "shared/transport/payload_type.hpp"

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

// A peer chooses its name: only what can't harm a terminal is shown of it.
std::string printable(const std::string& name) {
  std::string text = name.substr(0, 64);
  std::replace_if(
      text.begin(), text.end(), [](char c) { return c < ' ' || c > '~'; }, '?');
  return text;
}

}  // namespace

Participant::Impl::Impl(const ParticipantOptions& options) : paced_(options.max_bytes_per_second > 0.0) {
  check(options);
  route_middleware_log();
  const dds::DomainParticipantQos qos = participant_qos(options, warnings_);
  for (const std::string& warning : warnings_)
    spdlog::warn("transport: {}", warning);

  auto* factory = dds::DomainParticipantFactory::get_instance();
  participant_ = factory->create_participant(static_cast<dds::DomainId_t>(options.domain), qos, this,
                                             dds::StatusMask::none());
  if (participant_ == nullptr) {
    throw TransportError("DDS participant in domain " + std::to_string(options.domain) +
                         " could not be created: see the log lines before this");
  }
  publisher_ = participant_->create_publisher(dds::PUBLISHER_QOS_DEFAULT);
  subscriber_ = participant_->create_subscriber(dds::SUBSCRIBER_QOS_DEFAULT);
  if (publisher_ == nullptr || subscriber_ == nullptr) {
    release();
    throw TransportError("DDS publisher or subscriber could not be created");
  }
}

Participant::Impl::~Impl() {
  release();
}

void Participant::Impl::release() {
  participant_->set_listener(nullptr);
  participant_->delete_contained_entities();
  dds::DomainParticipantFactory::get_instance()->delete_participant(participant_);
}

dds::Topic& Participant::Impl::topic(const TopicProfile& profile) {
  return topic(std::string(profile.name), std::string(type_name(profile.kind)), false);
}

dds::Topic& Participant::Impl::topic(const std::string& name, const std::string& type, bool keyed) {
  const std::lock_guard lock(mutex_);
  if (auto* known = dynamic_cast<dds::Topic*>(participant_->lookup_topicdescription(name))) {
    if (known->get_type_name() == type) return *known;
    throw TransportError("DDS topic " + name + " is of type " + known->get_type_name() + " already, not " +
                         type);
  }
  if (participant_->find_type(type).empty()) {
    participant_->register_type(dds::TypeSupport(new PayloadType(type, keyed)));
  }
  dds::Topic* topic = participant_->create_topic(name, type, dds::TOPIC_QOS_DEFAULT);
  if (topic == nullptr) throw TransportError("DDS topic " + name + " could not be created");
  return *topic;
}

PeerCounters Participant::Impl::peers() const {
  const std::lock_guard lock(mutex_);
  return peers_;
}

void Participant::Impl::on_participant_discovery(dds::DomainParticipant* /*participant*/,
                                                 rtps::ParticipantDiscoveryInfo&& discovery) {
  using Info = rtps::ParticipantDiscoveryInfo;
  const std::string name = printable(discovery.info.m_participantName.to_string());
  const std::lock_guard lock(mutex_);
  switch (discovery.status) {
    case Info::DISCOVERED_PARTICIPANT:
      ++peers_.discovered;
      spdlog::info("transport: participant \"{}\" discovered", name);
      break;
    case Info::REMOVED_PARTICIPANT:
      ++peers_.left;
      spdlog::info("transport: participant \"{}\" left", name);
      break;
    case Info::DROPPED_PARTICIPANT:
      ++peers_.lost;
      spdlog::warn("transport: participant \"{}\" fell silent", name);
      break;
    default:
      break;
  }
}

void Participant::Impl::on_publisher_discovery(dds::DomainParticipant* /*participant*/,
                                               rtps::WriterDiscoveryInfo&& discovery) {
  writers_.update(discovery);
}

Participant::Participant(const ParticipantOptions& options) : impl_(std::make_shared<Impl>(options)) {}
Participant::~Participant() = default;

const std::vector<std::string>& Participant::warnings() const {
  return impl_->warnings();
}
PeerCounters Participant::peers() const {
  return impl_->peers();
}

}  // namespace cosight::transport
