#include "sim/render/exposure.hpp"

#include <algorithm>
#include <cmath>

#include "sim/random.hpp"

namespace cosight::sim {
namespace {

constexpr std::size_t kNoiseSize = 1U << 16U;
constexpr std::size_t kLevels = 256;

double mean_of(const std::vector<float>& brightness) {
  double sum = 0.0;
  for (const float value : brightness)
    sum += static_cast<double>(value);
  return sum / static_cast<double>(std::max<std::size_t>(1, brightness.size()));
}

}  // namespace

Exposure::Exposure(const ExposurePlan& plan, std::uint64_t seed) : plan_(plan), seed_(seed) {
  RandomStream random(seed, "pixel noise");
  for (std::size_t k = 0; k < kNoiseSize; ++k)
    noise_.push_back(static_cast<float>(random.normal()));
  for (std::size_t level = 0; level < kLevels; ++level) {
    const double shot = plan.shot_noise * std::sqrt(static_cast<double>(level));
    deviation_.push_back(static_cast<float>(std::hypot(plan.read_noise, shot)));
  }
}

float Exposure::gain_for(const Radiance& light) const {
  const double wanted = plan_.target / std::max(5.0, mean_of(light.brightness));
  return static_cast<float>(plan_.gain * std::pow(wanted, plan_.auto_exposure));
}

GrayImage Exposure::expose(const Radiance& light, std::uint64_t frame) const {
  const float gain = gain_for(light);
  GrayImage image{light.width, light.height, {}};
  image.data.resize(light.brightness.size());
  RandomStream random(seed_, "exposure", frame);
  const float middle_x = 0.5F * static_cast<float>(light.width);
  const float middle_y = 0.5F * static_cast<float>(light.height);
  const float darkening = static_cast<float>(plan_.vignetting) / (middle_x * middle_x + middle_y * middle_y);
  for (int row = 0; row < light.height; ++row) {
    const std::size_t start = static_cast<std::size_t>(row) * static_cast<std::size_t>(light.width);
    const std::size_t place = static_cast<std::size_t>(random.bits());
    const float y = static_cast<float>(row) - middle_y;
    for (std::size_t k = start; k < image.data.size() && k < start + static_cast<std::size_t>(light.width);
         ++k) {
      const float x = static_cast<float>(k - start) - middle_x;
      const float vignette = 1.0F - darkening * (x * x + y * y);
      const float value = std::clamp(gain * vignette * light.brightness[k], 0.0F, 255.0F);
      const float noise = deviation_[static_cast<std::size_t>(value)] * noise_[(place + k) % kNoiseSize];
      image.data[k] = static_cast<std::uint8_t>(std::clamp(value + noise + 0.5F, 0.0F, 255.0F));
    }
  }
  return image;
}

}  // namespace cosight::sim
