#include "sim/world/texture.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <cstdint>
#include <utility>

namespace cosight::sim {
namespace {

constexpr float kMaxTaps = 8.0F;

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

float bilinear(const GrayImage& image, float u, float v) {
  u = std::clamp(u - 0.5F, 0.0F, static_cast<float>(image.width - 1));
  v = std::clamp(v - 0.5F, 0.0F, static_cast<float>(image.height - 1));
  const int x = static_cast<int>(u);
  const int y = static_cast<int>(v);
  const float fx = u - static_cast<float>(x);
  const float fy = v - static_cast<float>(y);
  const int x_step = x + 1 < image.width ? 1 : 0;
  const std::uint8_t* above = image.row(y) + x;
  const std::uint8_t* below = y + 1 < image.height ? above + image.width : above;
  const float top = static_cast<float>(above[0]) + fx * static_cast<float>(above[x_step] - above[0]);
  const float bottom = static_cast<float>(below[0]) + fx * static_cast<float>(below[x_step] - below[0]);
  return top + fy * (bottom - top);
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

float Texture::sample(float u, float v, const Footprint& f) const {
  const float x_squared = f.du_dx * f.du_dx + f.dv_dx * f.dv_dx;
  const float y_squared = f.du_dy * f.du_dy + f.dv_dy * f.dv_dy;
  const bool x_longer = x_squared >= y_squared;
  const float long_squared = std::max(1e-12F, x_longer ? x_squared : y_squared);
  const float area = std::abs(f.du_dx * f.dv_dy - f.du_dy * f.dv_dx);
  // The short axis is area / long axis; one tap covers the short axis, so their ratio is the number of taps.
  const int taps = static_cast<int>(std::clamp(long_squared / std::max(area, 1e-6F) + 0.5F, 1.0F, kMaxTaps));
  const auto count = static_cast<float>(taps);
  const float lod = half_log2(std::max(1.0F, long_squared / (count * count)));
  const auto level = std::min(static_cast<std::size_t>(lod + 0.5F), levels_.size() - 1);
  const GrayImage& image = levels_[level];
  const auto u_scale = static_cast<float>(image.width) / static_cast<float>(width());
  const auto v_scale = static_cast<float>(image.height) / static_cast<float>(height());
  const float du = (x_longer ? f.du_dx : f.du_dy) / count;
  const float dv = (x_longer ? f.dv_dx : f.dv_dy) / count;
  float sum = 0.0F;
  for (int k = 0; k < taps; ++k) {
    const float offset = static_cast<float>(k) - 0.5F * (count - 1.0F);
    sum += bilinear(image, (u + offset * du) * u_scale, (v + offset * dv) * v_scale);
  }
  return sum / count;
}

}  // namespace cosight::sim
