#pragma once

#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// An image at full and at half resolution: pixel (i, j) of the half one is the mean of the four at (2i, 2j),
/// so that a half coordinate h lies at 2 h + 0.5 of the full image.
struct ImagePyramid {
  const GrayImage* full = nullptr;
  GrayImage half;
};

/// Fills `pyramid`, whose storage is kept. `image` has to outlive its use.
void build_pyramid(const GrayImage& image, ImagePyramid& pyramid);

}  // namespace cosight::vision
