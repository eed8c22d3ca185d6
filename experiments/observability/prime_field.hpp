#pragma once

#include <cstdint>

namespace cosight::experiments {

/// Numbers modulo the prime 2^61 - 1: every division is exact, zero is zero. A rational expression that is
/// not identically zero vanishes at a random point with a probability of about its degree / 2^61, so a rank
/// found here is the symbolic one.
class PrimeField {
 public:
  static constexpr std::uint64_t kPrime = (std::uint64_t{1} << 61U) - 1;

  constexpr PrimeField() = default;
  constexpr PrimeField(std::uint64_t value) : value_(value % kPrime) {}  // NOLINT(*-explicit-*): a number

  constexpr std::uint64_t value() const { return value_; }
  constexpr bool is_zero() const { return value_ == 0; }

  friend constexpr PrimeField operator+(PrimeField a, PrimeField b) { return {a.value_ + b.value_}; }
  friend constexpr PrimeField operator-(PrimeField a, PrimeField b) { return {a.value_ + kPrime - b.value_}; }
  friend constexpr PrimeField operator*(PrimeField a, PrimeField b) {
    return {static_cast<std::uint64_t>(Wide{a.value_} * b.value_ % kPrime)};
  }
  /// b is not zero.
  friend constexpr PrimeField operator/(PrimeField a, PrimeField b) { return a * b.inverse(); }

 private:
  __extension__ using Wide = unsigned __int128;

  /// Fermat: b^(p-2).
  constexpr PrimeField inverse() const {
    PrimeField result{1};
    PrimeField power = *this;
    for (std::uint64_t exponent = kPrime - 2; exponent != 0; exponent >>= 1U) {
      if ((exponent & 1U) != 0) result = result * power;
      power = power * power;
    }
    return result;
  }

  std::uint64_t value_ = 0;
};

}  // namespace cosight::experiments
