#include "shared/transport/payload_type.hpp"

#include <cstring>
#include <new>

namespace cosight::transport {

namespace rtps = eprosima::fastrtps::rtps;

namespace {

// First guess of a payload's size; longer ones are allocated when they come.
constexpr std::uint32_t kUsualBytes = 1024;

}  // namespace

PayloadType::PayloadType(const std::string& type_name, bool keyed) {
  setName(type_name.c_str());
  m_typeSize = kUsualBytes;
  m_isGetKeyDefined = keyed;
  auto_fill_type_object(false);
  auto_fill_type_information(false);
}

bool PayloadType::serialize(void* data, rtps::SerializedPayload_t* wire) {
  const auto& payload = *static_cast<const Payload*>(data);
  if (payload.size() > wire->max_size) return false;
  std::memcpy(wire->data, payload.data(), payload.size());
  wire->length = static_cast<std::uint32_t>(payload.size());
  wire->encapsulation = CDR_LE;
  return true;
}

bool PayloadType::deserialize(rtps::SerializedPayload_t* wire, void* data) {
  auto& payload = *static_cast<Payload*>(data);
  try {
    payload.assign(wire->data, wire->data + wire->length);
  } catch (const std::bad_alloc&) {
    payload.clear();  // which no codec takes for a sample
  }
  return true;
}

std::function<std::uint32_t()> PayloadType::getSerializedSizeProvider(void* data) {
  return [data] { return static_cast<std::uint32_t>(static_cast<const Payload*>(data)->size()); };
}

void* PayloadType::createData() {
  return new Payload;
}
void PayloadType::deleteData(void* data) {
  delete static_cast<Payload*>(data);
}
bool PayloadType::getKey(void* /*data*/, rtps::InstanceHandle_t* handle, bool /*force_md5*/) {
  if (!m_isGetKeyDefined) return false;
  handle->value[0] = 1;  // any but none
  return true;
}

}  // namespace cosight::transport
