#pragma once

#include <cstdint>
#include <vector>

namespace cosight::vision {

/// out[x] = sum over rows r < side and columns c < 16 of templ[16 r + c] * window[stride r + x + c], for
/// x = 0 … count - 1. Exact integers; the same on every machine. `templ` 32-byte aligned. Works in blocks of
/// kCorrelationBlock: `out` and the window's end must have room for a count rounded up to the next one.
constexpr int kCorrelationBlock = 4;
using CorrelateRow = void (*)(const std::int16_t* templ, int side, const std::int16_t* window, int stride,
                              int count, std::int32_t* out);

/// The plain loop.
void correlate_row_portable(const std::int16_t* templ, int side, const std::int16_t* window, int stride,
                            int count, std::int32_t* out);

/// The vector versions that this machine runs, the fastest last; may be none.
std::vector<CorrelateRow> vector_correlate_rows();

/// The fastest of all.
CorrelateRow fastest_correlate_row();

}  // namespace cosight::vision
