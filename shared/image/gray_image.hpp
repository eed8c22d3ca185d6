#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace cosight {

/// An 8-bit gray image, rows one after another without padding. The only image that crosses rooms: OpenCV
/// stays behind the rooms that need it (a cv::Mat header over `data` costs nothing).
struct GrayImage {
  int width = 0;
  int height = 0;
  std::vector<std::uint8_t> data;  ///< width * height bytes

  bool empty() const { return data.empty(); }
  const std::uint8_t* row(int y) const {
    return data.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
  std::uint8_t* row(int y) {
    return data.data() + static_cast<std::size_t>(y) * static_cast<std::size_t>(width);
  }
};

}  // namespace cosight
