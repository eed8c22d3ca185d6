#pragma once

#include <opencv2/core.hpp>

#include "shared/image/gray_image.hpp"

namespace cosight::vision {

/// A header over the image's own pixels: no copy, valid as long as the image. OpenCV has no read-only matrix;
/// never write through it.
inline cv::Mat opencv_view(const GrayImage& image) {
  // NOLINTNEXTLINE(cppcoreguidelines-pro-type-const-cast)
  return {image.height, image.width, CV_8UC1, const_cast<std::uint8_t*>(image.data.data())};
}

}  // namespace cosight::vision
