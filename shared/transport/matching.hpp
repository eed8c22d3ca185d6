#pragma once

#include <algorithm>
#include <chrono>

namespace cosight::transport {

/// Until each of `publishers` has a reader, or half a second is over. A robot reads several topics and its
/// readers match one after the other: what is sent before the last one has is lost. It need not read them
/// all.
template <class... Publishers>
void wait_for_further_readers(const Publishers&... publishers) {
  using std::chrono::milliseconds;
  constexpr milliseconds kMatching{500};
  const auto end = std::chrono::steady_clock::now() + kMatching;
  const auto left = [end] {
    const auto until = end - std::chrono::steady_clock::now();
    return std::max(std::chrono::duration_cast<milliseconds>(until), milliseconds{0});
  };
  (publishers.wait_for_readers(1, left()), ...);
}

}  // namespace cosight::transport
