#pragma once

#include <array>
#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string_view>
#include <type_traits>

#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

/// Appends records to a buffer, field by field, as MCAP wants them: little-endian, lengths before contents.
class FieldWriter {
 public:
  explicit FieldWriter(Bytes& bytes) : bytes_(bytes) {}

  template <class Number>
  FieldWriter& number(Number value) {
    static_assert(std::is_unsigned_v<Number> && std::endian::native == std::endian::little);
    const auto raw_value = std::bit_cast<std::array<std::uint8_t, sizeof(Number)>>(value);
    return raw(raw_value);
  }
  FieldWriter& time(Stamp stamp) { return number(static_cast<std::uint64_t>(stamp)); }
  FieldWriter& raw(ByteView bytes);
  FieldWriter& text(std::string_view text) {
    number(static_cast<std::uint32_t>(text.size()));
    return raw({reinterpret_cast<const std::uint8_t*>(text.data()), text.size()});
  }
  FieldWriter& map(const TextMap& entries) {
    return sized<std::uint32_t>([&] {
      for (const auto& [key, value] : entries)
        text(key).text(value);
    });
  }

  /// What `fill` writes, with its length in bytes before it.
  template <class Length, class Fill>
  FieldWriter& sized(Fill fill) {
    const std::size_t at = bytes_.size();
    number(Length{0});
    fill();
    const auto length = static_cast<Length>(bytes_.size() - at - sizeof(Length));
    std::memcpy(bytes_.data() + at, &length, sizeof(Length));
    return *this;
  }
  template <class Fill>
  FieldWriter& record(Opcode opcode, Fill fill) {
    number(static_cast<std::uint8_t>(opcode));
    return sized<std::uint64_t>(fill);
  }

 private:
  Bytes& bytes_;
};

}  // namespace cosight::recording
