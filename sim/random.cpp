#include "sim/random.hpp"

#include <cmath>
#include <numbers>

namespace cosight::sim {

std::uint64_t mix_bits(std::uint64_t bits) {
  bits = (bits ^ (bits >> 30U)) * 0xbf58476d1ce4e5b9ULL;
  bits = (bits ^ (bits >> 27U)) * 0x94d049bb133111ebULL;
  return bits ^ (bits >> 31U);
}

RandomStream::RandomStream(std::uint64_t seed, std::string_view purpose, std::uint64_t index)
    : state_(mix_bits(seed + 0x9e3779b97f4a7c15ULL)) {
  for (const char letter : purpose)
    state_ = mix_bits(state_ ^ static_cast<unsigned char>(letter));
  state_ = mix_bits(state_ + index * 0x9e3779b97f4a7c15ULL);
}

std::uint64_t RandomStream::bits() {
  state_ += 0x9e3779b97f4a7c15ULL;
  return mix_bits(state_);
}

double RandomStream::uniform() {
  return static_cast<double>(bits() >> 11U) * 0x1.0p-53;
}

double RandomStream::uniform(double low, double high) {
  return low + (high - low) * uniform();
}

double RandomStream::normal() {
  const double radius = std::sqrt(-2.0 * std::log(1.0 - uniform()));
  return radius * std::cos(2.0 * std::numbers::pi * uniform());
}

int RandomStream::below(int count) {
  return static_cast<int>(uniform() * count);
}

}  // namespace cosight::sim
