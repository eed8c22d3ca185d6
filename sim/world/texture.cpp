#include "sim/world/texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cosight::sim {
namespace {

constexpr float kMaxTaps = 8.0F;  // int sums hold 8 * 255 * kOne^2

GrayImage halved(const GrayImage& image) {
  GrayImage half{std::max(1, image.width / 2), std::max(1, image.height / 2), {}};
  half.data.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int y = 0; y < half.height; ++y) {
    const std::uint8_t* above = image.row(std::min(2 * y, image.height - 1));
    const std::uint8_t* below = image.row(std::min(2 * y + 1, image.height - 1));
    for (int x = 0; x < half.width; ++x) {
      const int left = std::min(2 * x, image.width - 1);
      const int right = std::min(2 * x + 1, image.width - 1);
      half.row(y)[x] =
          static_cast<std::uint8_t>((above[left] + above[right] + below[left] + below[right] + 2) / 4);
    }
  }
  return half;
}

/// Places in texels and weights are counted in parts of 1/256: integers are twice as fast here as floats.
constexpr int kFraction = 8;
constexpr int kOne = 1 << kFraction;

/// Bilinear value at (u, v), times kOne^2; (0, 0) is the centre of the first texel. Clamped at the border.
int bilinear(const GrayImage& image, int u, int v) {
  u = std::clamp(u, 0, (image.width - 1) * kOne);
  v = std::clamp(v, 0, (image.height - 1) * kOne);
  const int x = u >> kFraction;
  const int y = v >> kFraction;
  const int fx = u & (kOne - 1);
  const int fy = v & (kOne - 1);
  const std::uint8_t* above = image.row(y) + x;
  const std::uint8_t* below = above + (y + 1 < image.height ? image.width : 0);
  const int beside = x + 1 < image.width ? 1 : 0;
  const int top = above[0] * kOne + fx * (above[beside] - above[0]);
  const int bottom = below[0] * kOne + fx * (below[beside] - below[0]);
  return top * kOne + fy * (bottom - top);
}

/// Half the base-two logarithm of x, linear between powers of two: the level of a footprint of x texels
/// squared.
float half_log2(float x) {
  constexpr float kMantissa = 1.0F / (1U << 23U);
  return 0.5F * (static_cast<float>(std::bit_cast<std::int32_t>(x)) * kMantissa - 127.0F);
}

}  // namespace

Texture::Texture(GrayImage picture) {
  levels_.push_back(std::move(picture));
  while (levels_.back().width > 1 || levels_.back().height > 1)
    levels_.push_back(halved(levels_.back()));
}

Texture::Filter Texture::filter_for(const Footprint& f) const {
  const float x_squared = f.du_dx * f.du_dx + f.dv_dx * f.dv_dx;
  const float y_squared = f.du_dy * f.du_dy + f.dv_dy * f.dv_dy;
  const bool x_longer = x_squared >= y_squared;
  const float long_squared = std::max(1e-12F, x_longer ? x_squared : y_squared);
  const float area = std::abs(f.du_dx * f.dv_dy - f.du_dy * f.dv_dx);
  Filter filter;
  // The short axis is area / long axis; one tap covers the short axis, so their ratio is the number of taps.
  filter.taps =
      1 + static_cast<int>(std::clamp(long_squared / std::max(area, 1e-6F) - 0.5F, 0.0F, kMaxTaps - 1.0F));
  const auto count = static_cast<float>(filter.taps);
  // The nearest level: half a level up, cut off.
  const float nearest = half_log2(2.0F * std::max(1.0F, long_squared / (count * count)));
  filter.level = std::min(static_cast<int>(nearest), static_cast<int>(levels_.size()) - 1);
  const GrayImage& image = levels_[static_cast<std::size_t>(filter.level)];
  filter.u_scale = static_cast<float>(kOne * image.width) / static_cast<float>(width());
  filter.v_scale = static_cast<float>(kOne * image.height) / static_cast<float>(height());
  const float du = (x_longer ? f.du_dx : f.du_dy) * filter.u_scale / count;
  const float dv = (x_longer ? f.dv_dx : f.dv_dy) * filter.v_scale / count;
  filter.u_step = static_cast<int>(du);
  filter.v_step = static_cast<int>(dv);
  filter.u_first = static_cast<int>(-0.5F * (count - 1.0F) * du) - kOne / 2;
  filter.v_first = static_cast<int>(-0.5F * (count - 1.0F) * dv) - kOne / 2;
  filter.weight = 1.0F / (static_cast<float>(kOne * kOne) * count);
  return filter;
}

float Texture::sample(float u, float v, const Filter& filter) const {
  const GrayImage& image = levels_[static_cast<std::size_t>(filter.level)];
  int u_tap = static_cast<int>(u * filter.u_scale) + filter.u_first;
  int v_tap = static_cast<int>(v * filter.v_scale) + filter.v_first;
  int sum = bilinear(image, u_tap, v_tap);
  for (int k = 1; k < filter.taps; ++k) {
    u_tap += filter.u_step;
    v_tap += filter.v_step;
    sum += bilinear(image, u_tap, v_tap);
  }
  return static_cast<float>(sum) * filter.weight;
}

}  // namespace cosight::sim
