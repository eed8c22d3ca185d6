#pragma once

#include <cstdint>
#include <fastdds/dds/topic/TopicDataType.hpp>
#include <functional>
#include <string>
#include <vector>

namespace cosight::transport {

/// A type that Fast DDS moves as bytes. What the bytes mean is decided by the codecs, outside the
/// middleware's locks, and nothing that a peer sends can fail in here.
class PayloadType : public eprosima::fastdds::dds::TopicDataType {
 public:
  /// With the 4-byte encapsulation header, as it was or will be on the wire.
  using Payload = std::vector<std::uint8_t>;

  /// `keyed`: to match writers and readers of a type with a key; all samples count as one instance.
  explicit PayloadType(const std::string& type_name, bool keyed = false);

  bool serialize(void* data, eprosima::fastrtps::rtps::SerializedPayload_t* wire) override;
  bool deserialize(eprosima::fastrtps::rtps::SerializedPayload_t* wire, void* data) override;
  std::function<std::uint32_t()> getSerializedSizeProvider(void* data) override;
  void* createData() override;
  void deleteData(void* data) override;
  bool getKey(void* data, eprosima::fastrtps::rtps::InstanceHandle_t* handle, bool force_md5) override;
};

}  // namespace cosight::transport
