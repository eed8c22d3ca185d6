#pragma once

#include <bit>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <string>
#include <type_traits>

#include "shared/recording/mcap_records.hpp"

namespace cosight::recording {

/// Takes fields off a record that came from anywhere. A length beyond the record's end makes it bad for good:
/// every later field is then zero or empty, and nothing is read or allocated.
class FieldReader {
 public:
  explicit FieldReader(ByteView bytes) : rest_(bytes) {}

  bool good() const { return good_; }
  bool at_end() const { return rest_.empty(); }
  ByteView rest() const { return rest_; }

  template <class Number>
  Number number() {
    static_assert(std::is_unsigned_v<Number> && std::endian::native == std::endian::little);
    Number value = 0;
    const ByteView bytes = raw(sizeof(Number));
    if (good_) std::memcpy(&value, bytes.data(), sizeof(Number));
    return value;
  }
  /// MCAP's times are unsigned: beyond the year 2262 is bad.
  Stamp time() {
    const auto stamp = static_cast<Stamp>(number<std::uint64_t>());
    if (stamp < 0) good_ = false;
    return good_ ? stamp : 0;
  }
  ByteView raw(std::uint64_t length) {
    if (!good_ || length > rest_.size()) {
      good_ = false;
      rest_ = {};
      return {};
    }
    const ByteView bytes = rest_.first(length);
    rest_ = rest_.subspan(length);
    return bytes;
  }
  template <class Length>
  ByteView sized() {
    const Length length = number<Length>();
    return raw(length);
  }
  std::string text() {
    const ByteView bytes = sized<std::uint32_t>();
    return {bytes.begin(), bytes.end()};
  }
  TextMap map() {
    FieldReader entries(sized<std::uint32_t>());
    TextMap result;
    while (good_ && !entries.at_end()) {
      std::string key = entries.text();
      result[std::move(key)] = entries.text();
      good_ = entries.good();
    }
    return result;
  }

 private:
  ByteView rest_;
  bool good_ = true;
};

}  // namespace cosight::recording
