#pragma once

#include <cstdint>

#include "shared/recording/byte_sink.hpp"

namespace cosight::recording {

/// CRC-32 of IEEE 802.3, as in zip, PNG and MCAP; in pieces or at once.
class Crc32 {
 public:
  void add(ByteView bytes);
  std::uint32_t value() const { return ~state_; }

 private:
  std::uint32_t state_ = 0xFFFF'FFFF;
};

inline std::uint32_t crc32(ByteView bytes) {
  Crc32 crc;
  crc.add(bytes);
  return crc.value();
}

}  // namespace cosight::recording
