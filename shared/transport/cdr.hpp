#pragma once

#include <fastcdr/Cdr.h>
#include <fastcdr/FastBuffer.h>
#include <fastcdr/exceptions/Exception.h>

#include <cstddef>
#include <cstdint>
#include <exception>
#include <span>
#include <vector>

#include "shared/transport/codec.hpp"

namespace cosight::transport {

inline constexpr std::size_t kEncapsulationBytes = 4;  ///< representation and options, before the CDR body

/// A generated message as little-endian XCDR1.
template <class Message>
Fault serialize(const Message& message, std::size_t max_bytes, std::vector<std::uint8_t>& payload) {
  const std::size_t size = kEncapsulationBytes + Message::getCdrSerializedSize(message);
  if (size > max_bytes) return Fault::kTooLarge;
  payload.resize(size);
  try {
    eprosima::fastcdr::FastBuffer buffer(reinterpret_cast<char*>(payload.data()), payload.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.serialize_encapsulation();
    message.serialize(cdr);
    payload.resize(cdr.getSerializedDataLength());
  } catch (const eprosima::fastcdr::exception::Exception&) {
    return Fault::kMalformed;
  }
  return Fault::kNone;
}

/// Calls `read` on the body of a payload that came from anywhere. Fast CDR refuses lengths beyond the
/// payload; std::bad_alloc is caught with its refusals.
template <class Read>
Fault read_body(std::span<const std::uint8_t> payload, std::size_t max_bytes, Read read) {
  if (payload.size() > max_bytes) return Fault::kTooLarge;
  if (payload.size() < kEncapsulationBytes) return Fault::kMalformed;
  try {
    // Fast CDR reads through a pointer to non-const, and only reads.
    auto* bytes = const_cast<char*>(reinterpret_cast<const char*>(payload.data()));
    eprosima::fastcdr::FastBuffer buffer(bytes, payload.size());
    eprosima::fastcdr::Cdr cdr(buffer, eprosima::fastcdr::Cdr::LITTLE_ENDIANNESS,
                               eprosima::fastcdr::Cdr::DDS_CDR);
    cdr.read_encapsulation();
    read(cdr);
  } catch (const std::exception&) {
    return Fault::kMalformed;
  }
  return Fault::kNone;
}

/// A generated message from any bytes.
template <class Message>
Fault deserialize(std::span<const std::uint8_t> payload, std::size_t max_bytes, Message& message) {
  return read_body(payload, max_bytes, [&](eprosima::fastcdr::Cdr& cdr) { message.deserialize(cdr); });
}

}  // namespace cosight::transport
