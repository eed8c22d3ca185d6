#pragma once

#include <cstddef>

namespace cosight::vision {

/// An int that is known not to be negative, as an index: pixels are ints, containers count in std::size_t.
constexpr std::size_t index(int i) {
  return static_cast<std::size_t>(i);
}

}  // namespace cosight::vision
