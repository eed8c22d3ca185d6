#include "robot_agent/vision/image_pyramid.hpp"

namespace cosight::vision {

void build_pyramid(const GrayImage& image, ImagePyramid& pyramid) {
  pyramid.full = &image;
  GrayImage& half = pyramid.half;
  half.width = image.width / 2;
  half.height = image.height / 2;
  half.data.resize(static_cast<std::size_t>(half.width) * static_cast<std::size_t>(half.height));
  for (int j = 0; j < half.height; ++j) {
    const std::uint8_t* upper = image.row(2 * j);
    const std::uint8_t* lower = image.row(2 * j + 1);
    std::uint8_t* to = half.row(j);
    for (int i = 0; i < half.width; ++i) {
      to[i] = static_cast<std::uint8_t>(
          (upper[2 * i] + upper[2 * i + 1] + lower[2 * i] + lower[2 * i + 1] + 2) / 4);
    }
  }
}

}  // namespace cosight::vision
