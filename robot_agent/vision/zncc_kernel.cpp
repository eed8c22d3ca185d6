#include "robot_agent/vision/zncc_kernel.hpp"

#include <cstddef>

#if defined(__x86_64__)
#include <immintrin.h>
#endif

#include "robot_agent/vision/patch.hpp"

namespace cosight::vision {
namespace {

constexpr int kStride = Patch::kStride;

#if defined(__x86_64__)

// Four neighbouring positions share the loads of the template and one horizontal sum.

void correlate_row_sse2(const std::int16_t* templ, int side, const std::int16_t* window, int stride,
                        int count, std::int32_t* out) {
  for (int x = 0; x < count; x += kCorrelationBlock) {
    __m128i sum[4] = {};
    for (int r = 0; r < side; ++r) {
      const auto* t = reinterpret_cast<const __m128i*>(templ + static_cast<std::ptrdiff_t>(r) * kStride);
      const std::int16_t* w = window + static_cast<std::ptrdiff_t>(r) * stride + x;
      const __m128i t0 = _mm_load_si128(t);
      const __m128i t1 = _mm_load_si128(t + 1);
      for (int k = 0; k < 4; ++k) {
        const auto* v = reinterpret_cast<const __m128i*>(w + k);
        sum[k] = _mm_add_epi32(sum[k], _mm_madd_epi16(t0, _mm_loadu_si128(v)));
        sum[k] = _mm_add_epi32(sum[k], _mm_madd_epi16(t1, _mm_loadu_si128(v + 1)));
      }
    }
    const __m128i a = _mm_add_epi32(_mm_unpacklo_epi32(sum[0], sum[1]), _mm_unpackhi_epi32(sum[0], sum[1]));
    const __m128i b = _mm_add_epi32(_mm_unpacklo_epi32(sum[2], sum[3]), _mm_unpackhi_epi32(sum[2], sum[3]));
    const __m128i total = _mm_add_epi32(_mm_unpacklo_epi64(a, b), _mm_unpackhi_epi64(a, b));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + x), total);
  }
}

__attribute__((target("avx2"))) void correlate_row_avx2(const std::int16_t* templ, int side,
                                                        const std::int16_t* window, int stride, int count,
                                                        std::int32_t* out) {
  for (int x = 0; x < count; x += kCorrelationBlock) {
    __m256i sum[4] = {};
    for (int r = 0; r < side; ++r) {
      const __m256i t = _mm256_load_si256(
          reinterpret_cast<const __m256i*>(templ + static_cast<std::ptrdiff_t>(r) * kStride));
      const std::int16_t* w = window + static_cast<std::ptrdiff_t>(r) * stride + x;
      for (int k = 0; k < 4; ++k) {
        const __m256i v = _mm256_loadu_si256(reinterpret_cast<const __m256i*>(w + k));
        sum[k] = _mm256_add_epi32(sum[k], _mm256_madd_epi16(t, v));
      }
    }
    const __m256i pairs =
        _mm256_hadd_epi32(_mm256_hadd_epi32(sum[0], sum[1]), _mm256_hadd_epi32(sum[2], sum[3]));
    const __m128i total = _mm_add_epi32(_mm256_castsi256_si128(pairs), _mm256_extracti128_si256(pairs, 1));
    _mm_storeu_si128(reinterpret_cast<__m128i*>(out + x), total);
  }
}

#endif

}  // namespace

void correlate_row_portable(const std::int16_t* templ, int side, const std::int16_t* window, int stride,
                            int count, std::int32_t* out) {
  for (int x = 0; x < count; ++x) {
    std::int32_t sum = 0;
    for (int r = 0; r < side; ++r) {
      const std::int16_t* t = templ + static_cast<std::ptrdiff_t>(r) * kStride;
      const std::int16_t* w = window + static_cast<std::ptrdiff_t>(r) * stride + x;
      for (int c = 0; c < kStride; ++c)
        sum += static_cast<std::int32_t>(t[c]) * w[c];
    }
    out[x] = sum;
  }
}

std::vector<CorrelateRow> vector_correlate_rows() {
  std::vector<CorrelateRow> rows;
#if defined(__x86_64__)
  rows.push_back(correlate_row_sse2);
  if (__builtin_cpu_supports("avx2")) rows.push_back(correlate_row_avx2);
#endif
  return rows;
}

CorrelateRow fastest_correlate_row() {
  const std::vector<CorrelateRow> rows = vector_correlate_rows();
  return rows.empty() ? correlate_row_portable : rows.back();
}

}  // namespace cosight::vision
