#include "shared/transport/discovered_writers.hpp"

#include <fastdds/rtps/builtin/data/WriterProxyData.h>

#include <algorithm>
#include <fastdds/dds/core/policy/QosPolicies.hpp>

namespace cosight::transport {

namespace dds = eprosima::fastdds::dds;
namespace rtps = eprosima::fastrtps::rtps;

namespace {

/// 0 for a duration without end.
double seconds(const eprosima::fastrtps::Duration_t& duration) {
  return duration == eprosima::fastrtps::c_TimeInfinite ? 0.0 : static_cast<double>(duration.to_ns()) * 1e-9;
}

BlindQos qos_of(const dds::WriterQos& offered) {
  BlindQos qos;
  qos.reliable = offered.m_reliability.kind == dds::RELIABLE_RELIABILITY_QOS;
  qos.transient_local = offered.m_durability.kind >= dds::TRANSIENT_LOCAL_DURABILITY_QOS;
  qos.liveliness_lease = seconds(offered.m_liveliness.lease_duration);
  qos.deadline = seconds(offered.m_deadline.period);
  qos.exclusive = offered.m_ownership.kind == dds::EXCLUSIVE_OWNERSHIP_QOS;
  qos.partitions = offered.m_partition.getNames();
  return qos;
}

}  // namespace

std::array<std::uint8_t, 16> writer_id(const rtps::GUID_t& guid) {
  std::array<std::uint8_t, 16> id{};
  std::copy_n(guid.guidPrefix.value, rtps::GuidPrefix_t::size, id.begin());
  std::copy_n(guid.entityId.value, rtps::EntityId_t::size, id.begin() + rtps::GuidPrefix_t::size);
  return id;
}

void DiscoveredWriters::update(const rtps::WriterDiscoveryInfo& discovery) {
  const rtps::WriterProxyData& data = discovery.info;
  const auto id = writer_id(data.guid());
  const std::lock_guard lock(mutex_);
  if (discovery.status == rtps::WriterDiscoveryInfo::REMOVED_WRITER) {
    writers_.erase(id);
    return;
  }
  BlindTopic topic{.name = data.topicName().to_string(),
                   .type = data.typeName().to_string(),
                   .keyed = data.topicKind() == rtps::WITH_KEY,
                   .qos = qos_of(data.m_qos)};
  writers_.insert_or_assign(id, DiscoveredWriter{id, std::move(topic)});
}

std::vector<DiscoveredWriter> DiscoveredWriters::all() const {
  const std::lock_guard lock(mutex_);
  std::vector<DiscoveredWriter> all;
  all.reserve(writers_.size());
  for (const auto& [id, writer] : writers_)
    all.push_back(writer);
  return all;
}

}  // namespace cosight::transport
