#pragma once

#include <array>
#include <cstddef>

namespace cosight::experiments {

/// A value with its exact gradient by N variables (forward differentiation), over any field.
template <class Field, std::size_t N>
struct Dual {
  Field value{};
  std::array<Field, N> gradient{};

  static Dual constant(const Field& value) { return {value, {}}; }
  static Dual variable(const Field& value, std::size_t index) {
    Dual result{value, {}};
    result.gradient.at(index) = Field{1};
    return result;
  }

  friend Dual operator+(const Dual& a, const Dual& b) {
    return combined(a.value + b.value, Field{1}, a, Field{1}, b);
  }
  friend Dual operator-(const Dual& a, const Dual& b) {
    return combined(a.value - b.value, Field{1}, a, Field{0} - Field{1}, b);
  }
  friend Dual operator*(const Dual& a, const Dual& b) {
    return combined(a.value * b.value, b.value, a, a.value, b);
  }
  friend Dual operator/(const Dual& a, const Dual& b) {
    const Field inverse = Field{1} / b.value;
    const Field quotient = a.value * inverse;
    return combined(quotient, inverse, a, Field{0} - quotient * inverse, b);
  }

 private:
  /// A function of a and b with the given value and partial derivatives.
  static Dual combined(const Field& value, const Field& by_a, const Dual& a, const Field& by_b,
                       const Dual& b) {
    Dual result{value, {}};
    for (std::size_t i = 0; i < N; ++i)
      result.gradient[i] = by_a * a.gradient[i] + by_b * b.gradient[i];
    return result;
  }
};

}  // namespace cosight::experiments
