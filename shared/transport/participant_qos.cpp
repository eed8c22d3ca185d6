#include "shared/transport/participant_qos.hpp"

#include <fastrtps/attributes/LibrarySettingsAttributes.h>
#include <fastrtps/xmlparser/XMLProfileManager.h>

#include <fastdds/rtps/transport/UDPv4TransportDescriptor.h>
#include <fastdds/rtps/transport/shared_mem/SharedMemTransportDescriptor.h>
#include <algorithm>
#include <cstdint>
#include <cstdlib>
#include <fastdds/dds/domain/DomainParticipantFactory.hpp>
#include <fastdds/rtps/flowcontrol/FlowControllerDescriptor.hpp>
#include <filesystem>
#include <memory>

#include "shared/transport/network.hpp"

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastdds::rtps;
namespace legacy = eprosima::fastrtps;

namespace {

constexpr const char* kProfile = "cosight";
constexpr const char* kFlowController = "cosight_paced";
constexpr const char* kProfilesVariable = "FASTRTPS_DEFAULT_PROFILES_FILE";

constexpr int kSmallestMessage = 256;
constexpr int kLargestMessage = 65500;  // of UDP, less the headers
constexpr std::uint32_t kSharedSegment = 32U << 20;

// A killed process is forgotten after 2 s instead of 20.
constexpr double kParticipantLease = 2.0;
constexpr double kAnnouncementPeriod = 0.5;

// [ms] What is left of a period when the thread wakes up late is lost. On a busy machine, at 1.5 x the
// stream, 10 ms let 27 to 132 of 150 raw frames through, 100 ms all of them; its price are bursts of a tenth
// of a second.
constexpr std::uint64_t kPacePeriod = 100;

legacy::Duration_t seconds(double s) {
  return legacy::Duration_t(static_cast<long double>(s));
}

/// UDP that sends small datagrams and still receives large ones. Fast DDS fragments by what the descriptor
/// says and sizes the receive buffer by the transport's own copy of the field, so the two may differ. Small
/// when sending: a datagram of many IP fragments is lost with any one of them, and clogs the reassembly for
/// 30 s. Large when receiving: whatever is larger than the buffer is dropped without a word, and other
/// vendors send it.
class SmallDatagrams : public rtps::UDPv4TransportDescriptor {
 public:
  explicit SmallDatagrams(int bytes) : bytes_(static_cast<std::uint32_t>(bytes)) {}
  std::uint32_t max_message_size() const override { return bytes_; }

 private:
  std::uint32_t bytes_;
};

std::shared_ptr<rtps::TransportDescriptorInterface> udp(const ParticipantOptions& options) {
  auto transport = std::make_shared<SmallDatagrams>(options.max_message_size);
  transport->maxMessageSize = kLargestMessage;
  transport->sendBufferSize = static_cast<std::uint32_t>(options.socket_buffer);
  transport->receiveBufferSize = static_cast<std::uint32_t>(options.socket_buffer);
  for (const std::string& interface : options.interfaces) {
    transport->interfaceWhiteList.push_back(ipv4_of_interface(interface));
  }
  return transport;
}

std::shared_ptr<rtps::TransportDescriptorInterface> shared_memory() {
  auto transport = std::make_shared<rtps::SharedMemTransportDescriptor>();
  transport->segment_size(kSharedSegment);
  return transport;
}

void add_peers(const ParticipantOptions& options, dds::DomainParticipantQos& qos) {
  if (options.peers.empty()) return;
  auto& builtin = qos.wire_protocol().builtin;
  legacy::rtps::Locator_t locator;  // port 0: the well-known ports of the first participants of that host
  legacy::rtps::IPLocator::setIPv4(locator, "239.255.0.1");
  builtin.initialPeersList.push_back(locator);
  for (const std::string& peer : options.peers) {
    if (!legacy::rtps::IPLocator::setIPv4(locator, peer)) {
      throw TransportError("peer \"" + peer + "\" is no IPv4 address");
    }
    builtin.initialPeersList.push_back(locator);
  }
}

// Images and maps pass through it; orientations, poses and heartbeats go at once.
void add_flow_controller(const ParticipantOptions& options, dds::DomainParticipantQos& qos) {
  if (options.max_bytes_per_second <= 0.0) return;
  const double budget = options.max_bytes_per_second * static_cast<double>(kPacePeriod) * 1e-3;
  auto controller = std::make_shared<rtps::FlowControllerDescriptor>();
  controller->name = kFlowController;
  controller->max_bytes_per_period =
      static_cast<std::int32_t>(std::clamp(budget, 2.0 * options.max_message_size, 1e9));
  controller->period_ms = kPacePeriod;
  qos.flow_controllers().push_back(controller);
}

dds::DomainParticipantQos qos_of_options(const ParticipantOptions& options) {
  dds::DomainParticipantQos qos;
  qos.name(options.name);
  qos.transport().use_builtin_transports = false;
  qos.transport().user_transports.push_back(udp(options));
  if (options.shared_memory) qos.transport().user_transports.push_back(shared_memory());
  auto& discovery = qos.wire_protocol().builtin.discovery_config;
  discovery.leaseDuration = seconds(kParticipantLease);
  discovery.leaseDuration_announcementperiod = seconds(kAnnouncementPeriod);
  add_peers(options, qos);
  return qos;
}

// Environment profiles are read lazily otherwise: a default asked for before the first participant ignores
// them.
void load_profiles(const ParticipantOptions& options, std::vector<std::string>& warnings) {
  const char* variable = std::getenv(kProfilesVariable);
  if (variable != nullptr && !std::filesystem::exists(variable)) {
    warnings.push_back(std::string(kProfilesVariable) + " names " + variable + ", which does not exist");
  }
  auto* factory = dds::DomainParticipantFactory::get_instance();
  factory->load_profiles();
  if (options.profile_file.empty()) return;
  if (!std::filesystem::exists(options.profile_file)) {
    throw TransportError("DDS profile file " + options.profile_file + " does not exist");
  }
  if (factory->load_XML_profiles_file(options.profile_file) != legacy::types::ReturnCode_t::RETCODE_OK) {
    throw TransportError("DDS profile file " + options.profile_file + " is no valid Fast DDS XML");
  }
}

// Samples of a writer in this process come through the sockets as all others do: callbacks are always on a
// receiving thread, never inside someone's publish().
void deliver_through_sockets() {
  legacy::LibrarySettingsAttributes settings;
  settings.intraprocess_delivery = legacy::INTRAPROCESS_OFF;
  legacy::xmlparser::XMLProfileManager::library_settings(settings);
}

bool qos_of_profile(dds::DomainParticipantQos& qos) {
  auto* factory = dds::DomainParticipantFactory::get_instance();
  if (factory->get_participant_qos_from_profile(kProfile, qos) == legacy::types::ReturnCode_t::RETCODE_OK) {
    return true;
  }
  factory->get_default_participant_qos(qos);
  return !(qos == dds::PARTICIPANT_QOS_DEFAULT);
}

void require(bool in_range, const std::string& what) {
  if (!in_range) throw TransportError("transport: " + what);
}

}  // namespace

void check(const ParticipantOptions& options) {
  require(options.domain >= 0 && options.domain <= 232,
          "domain " + std::to_string(options.domain) + " is not in [0, 232]");
  require(options.max_message_size >= kSmallestMessage && options.max_message_size <= kLargestMessage,
          "max_message_size " + std::to_string(options.max_message_size) + " is not in [256, 65500]");
  require(options.socket_buffer >= kLargestMessage,
          "socket_buffer " + std::to_string(options.socket_buffer) + " is less than 65500");
  require(options.max_bytes_per_second >= 0.0 && options.max_bytes_per_second <= 1e11,
          "max_bytes_per_second is not in [0, 1e11]");
}

dds::DomainParticipantQos participant_qos(const ParticipantOptions& options,
                                          std::vector<std::string>& warnings) {
  load_profiles(options, warnings);
  deliver_through_sockets();
  dds::DomainParticipantQos qos;
  if (!qos_of_profile(qos)) {
    qos = qos_of_options(options);
    if (const std::string refusal = refused_socket_buffer(options.socket_buffer); !refusal.empty()) {
      warnings.push_back(refusal);
    }
  }
  add_flow_controller(options, qos);
  return qos;
}

dds::DataWriterQos writer_qos(const TopicProfile& topic, bool paced, const dds::Publisher& publisher) {
  dds::DataWriterQos qos;
  const std::string name(topic.name);
  if (publisher.get_datawriter_qos_from_profile(name, qos) == legacy::types::ReturnCode_t::RETCODE_OK) {
    return qos;
  }
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  qos.reliability().max_blocking_time = seconds(0.1);
  qos.durability().kind = dds::TRANSIENT_LOCAL_DURABILITY_QOS;  // see TopicProfile
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.depth;
  qos.publish_mode().kind =
      dds::ASYNCHRONOUS_PUBLISH_MODE;  // a full socket holds up its thread, not the caller
  if (paced && topic.paced) qos.publish_mode().flow_controller_name = kFlowController;
  if (topic.liveliness_lease > 0.0) {
    qos.liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = seconds(topic.liveliness_lease);
    qos.liveliness().announcement_period = seconds(topic.liveliness_lease / 4.0);
  }
  // By default a lost last sample waits 3 s for the heartbeat that tells the reader what it lacks.
  qos.reliable_writer_qos().times.initialHeartbeatDelay = seconds(0.0);
  qos.reliable_writer_qos().times.heartbeatPeriod = seconds(0.02);
  qos.reliable_writer_qos().times.nackResponseDelay = seconds(0.0);
  qos.data_sharing().off();  // its readers see memory that the writer already fills again
  return qos;
}

dds::DataReaderQos reader_qos(const TopicProfile& topic, const dds::Subscriber& subscriber) {
  dds::DataReaderQos qos;
  const std::string name(topic.name);
  if (subscriber.get_datareader_qos_from_profile(name, qos) == legacy::types::ReturnCode_t::RETCODE_OK) {
    return qos;
  }
  qos.reliability().kind = dds::RELIABLE_RELIABILITY_QOS;
  // A robot that comes late wants the frames from now on, not the last second's; but it wants the
  // calibration.
  qos.durability().kind = topic.latched ? dds::TRANSIENT_LOCAL_DURABILITY_QOS : dds::VOLATILE_DURABILITY_QOS;
  qos.history().kind = dds::KEEP_LAST_HISTORY_QOS;
  qos.history().depth = topic.depth;
  if (topic.liveliness_lease > 0.0) {
    qos.liveliness().kind = dds::AUTOMATIC_LIVELINESS_QOS;
    qos.liveliness().lease_duration = seconds(topic.liveliness_lease);
  }
  qos.reliable_reader_qos().times.heartbeatResponseDelay = seconds(0.0);
  qos.data_sharing().off();
  return qos;
}

}  // namespace cosight::transport
