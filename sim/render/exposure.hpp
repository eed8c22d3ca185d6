#pragma once

#include <cstdint>
#include <vector>

#include "shared/image/gray_image.hpp"
#include "sim/render/renderer.hpp"

namespace cosight::sim {

/// How a sensor turns light into gray levels.
struct ExposurePlan {
  double gain = 1.0;           ///< factor on the brightness
  double auto_exposure = 0.0;  ///< 0 … 1: how much of the way to `target` the gain goes in each picture
  double target = 115.0;       ///< mean brightness the automatic wants [gray levels]
  double read_noise = 1.5;     ///< [gray levels]
  double shot_noise = 0.12;    ///< [gray levels at brightness 1]; grows with the root of the brightness
  double vignetting = 0.15;    ///< how much darker the corners are, 0 … 1
};

/// An image sensor. The noise of a frame depends on the seed and the frame's number alone.
class Exposure {
 public:
  Exposure(const ExposurePlan& plan, std::uint64_t seed);

  GrayImage expose(const Radiance& light, std::uint64_t frame) const;

 private:
  float gain_for(const Radiance& light) const;

  ExposurePlan plan_;
  std::uint64_t seed_;
  std::vector<float> noise_;      ///< normal deviates, drawn once and read from another place in every row
  std::vector<float> deviation_;  ///< of each gray level [gray levels]
};

}  // namespace cosight::sim
