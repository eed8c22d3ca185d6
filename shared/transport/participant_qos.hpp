#pragma once

#include <fastdds/dds/domain/qos/DomainParticipantQos.hpp>
#include <fastdds/dds/publisher/Publisher.hpp>
#include <fastdds/dds/publisher/qos/DataWriterQos.hpp>
#include <fastdds/dds/subscriber/Subscriber.hpp>
#include <fastdds/dds/subscriber/qos/DataReaderQos.hpp>
#include <string>
#include <vector>

#include "shared/transport/participant.hpp"
#include "shared/transport/topics.hpp"

namespace cosight::transport {

/// Throws TransportError when a value is out of its range.
void check(const ParticipantOptions& options);

/// The participant's settings: from an XML profile when there is one, else from the options. `warnings`: what
/// the kernel or the environment refuses. Throws TransportError on a profile file or interface that isn't
/// there.
eprosima::fastdds::dds::DomainParticipantQos participant_qos(const ParticipantOptions& options,
                                                             std::vector<std::string>& warnings);

/// A topic's writer and reader: the XML profile of the topic's name when there is one, else from the table.
eprosima::fastdds::dds::DataWriterQos writer_qos(const TopicProfile& topic, bool paced,
                                                 const eprosima::fastdds::dds::Publisher& publisher);
eprosima::fastdds::dds::DataReaderQos reader_qos(const TopicProfile& topic,
                                                 const eprosima::fastdds::dds::Subscriber& subscriber);

}  // namespace cosight::transport
