#pragma once

#include <opencv2/core/mat.hpp>

#include "sim/random.hpp"
#include "sim/world/material.hpp"

namespace cosight::sim {

/// A picture of the material, `width` x `height` [m], at `texel` [m] a texel (8 bit, one channel).
cv::Mat paint_material(Material material, double width, double height, double texel, RandomStream random);

/// Noise of many scales, mean 0, about ±1: `coarsest` the largest blob's size [texels].
cv::Mat multi_scale_noise(const cv::Size& size, double coarsest, RandomStream& random);

}  // namespace cosight::sim
