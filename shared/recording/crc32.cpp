#include "shared/recording/crc32.hpp"

#include <array>
#include <bit>
#include <cstring>

namespace cosight::recording {
namespace {

static_assert(std::endian::native == std::endian::little, "words are read as they lie in memory");

constexpr std::size_t kSlices = 16;
using Tables = std::array<std::array<std::uint32_t, 256>, kSlices>;

/// tables[k][b]: the remainder of byte b followed by k zero bytes.
constexpr Tables make_tables() {
  constexpr std::uint32_t kPolynomial = 0xEDB8'8320;
  Tables tables{};
  for (std::uint32_t byte = 0; byte < 256; ++byte) {
    std::uint32_t remainder = byte;
    for (int bit = 0; bit < 8; ++bit)
      remainder = (remainder >> 1) ^ ((remainder & 1) != 0 ? kPolynomial : 0);
    tables[0][byte] = remainder;
  }
  for (std::size_t k = 1; k < kSlices; ++k) {
    for (std::size_t byte = 0; byte < 256; ++byte) {
      const std::uint32_t before = tables[k - 1][byte];
      tables[k][byte] = (before >> 8) ^ tables[0][before & 0xFF];
    }
  }
  return tables;
}
constexpr Tables kTables = make_tables();

/// The remainder of four bytes followed by `zeros` zero bytes.
std::uint32_t of_word(std::uint32_t word, std::size_t zeros) {
  return kTables[zeros + 3][word & 0xFF] ^ kTables[zeros + 2][(word >> 8) & 0xFF] ^
         kTables[zeros + 1][(word >> 16) & 0xFF] ^ kTables[zeros][word >> 24];
}

}  // namespace

void Crc32::add(ByteView bytes) {
  std::uint32_t crc = state_;
  for (; bytes.size() >= kSlices; bytes = bytes.subspan(kSlices)) {
    std::array<std::uint32_t, 4> words{};
    std::memcpy(words.data(), bytes.data(), kSlices);
    crc = of_word(words[0] ^ crc, 12) ^ of_word(words[1], 8) ^ of_word(words[2], 4) ^ of_word(words[3], 0);
  }
  for (const std::uint8_t byte : bytes)
    crc = (crc >> 8) ^ kTables[0][(crc ^ byte) & 0xFF];
  state_ = crc;
}

}  // namespace cosight::recording
