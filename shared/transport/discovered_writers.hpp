#pragma once

#include <fastdds/rtps/common/Guid.h>
#include <fastdds/rtps/writer/WriterDiscoveryInfo.h>

#include <array>
#include <cstdint>
#include <map>
#include <mutex>
#include <vector>

#include "shared/transport/blind_topic.hpp"

namespace cosight::transport {

std::array<std::uint8_t, 16> writer_id(const eprosima::fastrtps::rtps::GUID_t& guid);

/// Keeps up with the writers that come and go in the domain. Any thread.
class DiscoveredWriters {
 public:
  void update(const eprosima::fastrtps::rtps::WriterDiscoveryInfo& discovery);
  std::vector<DiscoveredWriter> all() const;

 private:
  mutable std::mutex mutex_;
  std::map<std::array<std::uint8_t, 16>, DiscoveredWriter> writers_;
};

}  // namespace cosight::transport
