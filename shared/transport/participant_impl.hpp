#pragma once

#include <fastdds/dds/domain/DomainParticipant.hpp>
#include <fastdds/dds/domain/DomainParticipantListener.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/topic/Topic.hpp>
#include <mutex>
#include <string>
#include <vector>

#include "shared/transport/discovered_writers.hpp"
#include "shared/transport/participant.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

/// The Fast DDS entities behind a Participant.
class Participant::Impl : private eprosima::fastdds::dds::DomainParticipantListener {
 public:
  explicit Impl(const ParticipantOptions& options);
  ~Impl() override;
  Impl(const Impl&) = delete;
  Impl& operator=(const Impl&) = delete;

  eprosima::fastdds::dds::Publisher& publisher() { return *publisher_; }
  eprosima::fastdds::dds::Subscriber& subscriber() { return *subscriber_; }

  eprosima::fastdds::dds::DomainParticipant& entity() { return *participant_; }

  /// Registered once a participant, whoever asks first.
  eprosima::fastdds::dds::Topic& topic(const TopicProfile& profile);
  eprosima::fastdds::dds::Topic& topic(const std::string& name, const std::string& type, bool keyed);

  bool paced() const { return paced_; }
  const std::vector<std::string>& warnings() const { return warnings_; }
  PeerCounters peers() const;
  const DiscoveredWriters& writers() const { return writers_; }

 private:
  void on_participant_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                                eprosima::fastrtps::rtps::ParticipantDiscoveryInfo&& discovery) override;
  void on_publisher_discovery(eprosima::fastdds::dds::DomainParticipant* participant,
                              eprosima::fastrtps::rtps::WriterDiscoveryInfo&& discovery) override;
  void release();

  bool paced_;
  std::vector<std::string> warnings_;
  eprosima::fastdds::dds::DomainParticipant* participant_ = nullptr;
  eprosima::fastdds::dds::Publisher* publisher_ = nullptr;
  eprosima::fastdds::dds::Subscriber* subscriber_ = nullptr;
  mutable std::mutex mutex_;
  PeerCounters peers_;
  DiscoveredWriters writers_;
};

}  // namespace cosight::transport
