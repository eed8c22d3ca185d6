#include "tools/prepare/lens_change.hpp"

#include <algorithm>
#include <cmath>

namespace cosight {
namespace {

/// Bilinear, clamped to the image.
std::uint8_t intensity_at(const GrayImage& image, const Eigen::Vector2d& pixel) {
  const double x = std::clamp(pixel.x(), 0.0, static_cast<double>(image.width - 1));
  const double y = std::clamp(pixel.y(), 0.0, static_cast<double>(image.height - 1));
  const int x0 = std::min(static_cast<int>(x), image.width - 2);
  const int y0 = std::min(static_cast<int>(y), image.height - 2);
  const double ax = x - x0;
  const double ay = y - y0;
  const std::uint8_t* upper = image.row(y0) + x0;
  const std::uint8_t* lower = image.row(y0 + 1) + x0;
  const double value =
      (1 - ay) * ((1 - ax) * upper[0] + ax * upper[1]) + ay * ((1 - ax) * lower[0] + ax * lower[1]);
  return static_cast<std::uint8_t>(std::lround(value));
}

}  // namespace

GrayImage with_other_lens(const GrayImage& image, const CameraModel& from, const CameraModel& to) {
  GrayImage result;
  result.width = to.width;
  result.height = to.height;
  result.data.resize(static_cast<std::size_t>(to.width) * static_cast<std::size_t>(to.height));
  for (int y = 0; y < to.height; ++y) {
    for (int x = 0; x < to.width; ++x) {
      const auto ray = to.unproject({x, y});
      const auto pixel = ray ? from.project(*ray) : std::nullopt;
      if (pixel) result.row(y)[x] = intensity_at(image, *pixel);
    }
  }
  return result;
}

}  // namespace cosight
